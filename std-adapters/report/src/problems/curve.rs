//! Functions of one variable, sampled for a plot.

/// What the horizontal axis of a problem's plot is.
pub type Axis = &'static str;

/// Which function a curve shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The integrand, divided by its integral.
    Integrand,
    /// The auxiliary, divided by its integral.
    Auxiliary,
    /// The density of the draws.
    Proposal,
}

/// A function of one variable.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Whose it is; empty where there is only one channel.
    pub channel: String,
    /// Numbers the channels that are shown: curves of one channel share a colour.
    pub group: usize,
    /// Which function.
    pub role: Role,
    /// Points of its graph, from left to right.
    pub points: Vec<(f64, f64)>,
}

impl Curve {
    /// The graph of `function` on \[0, 1\], through 401 points.
    pub(crate) fn of(channel: String, group: usize, role: Role, function: impl Fn(f64) -> f64) -> Self {
        let points = (0..=400).map(|i| f64::from(i) / 400.0).map(|x| (x, function(x))).collect();
        Self { channel, group, role, points }
    }

    /// f/F and h/H of a single channel.
    pub(crate) fn pair(f: impl Fn(f64) -> f64, h: impl Fn(f64) -> f64) -> Vec<Self> {
        vec![Self::of(String::new(), 0, Role::Integrand, f), Self::of(String::new(), 0, Role::Auxiliary, h)]
    }
}
