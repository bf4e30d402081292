//! The bars that our accumulators must clear, against contenders in the same run.

use std::fmt;

/// What the program was built for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Build {
    /// Any x86-64.
    Default,
    /// x86-64-v3: AVX2.
    V3,
    /// AVX-512.
    Avx512,
}

impl Build {
    /// Of this program.
    pub const THIS: Self = if cfg!(target_feature = "avx512f") {
        Self::Avx512
    } else if cfg!(target_feature = "avx2") {
        Self::V3
    } else {
        Self::Default
    };

    /// The flag for rustc that makes such a build here.
    pub const fn flag(self) -> &'static str {
        match self {
            Self::Default => "",
            Self::V3 => "-C target-cpu=x86-64-v3",
            Self::Avx512 => "-C target-cpu=native",
        }
    }
}

/// What the ids of those end in that pick the machine's level at run time.
const DISPATCHED: &str = "-dispatched";

/// How ours must do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Demand {
    /// At most so many times the rival's time.
    Within(f64),
    /// At most one so-many-th of the rival's time.
    Faster(f64),
}

impl Demand {
    /// Whether `ratio`, our time over the rival's, is good enough. NaN is not.
    pub fn met_by(self, ratio: f64) -> bool {
        match self {
            Self::Within(most) => ratio <= most,
            Self::Faster(least) => 1.0 / ratio >= least,
        }
    }
}

impl fmt::Display for Demand {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Within(most) => write!(out, "at most {most} × its time"),
            Self::Faster(least) => write!(out, "at least {least} × faster"),
        }
    }
}

/// One bar, for every contender of `set` whose id starts with "ours".
#[derive(Clone, Copy, Debug)]
pub struct Bar {
    /// Where ours is.
    pub set: &'static str,
    /// Set and id of the rival.
    pub rival: &'static str,
    /// What is asked.
    pub demand: Demand,
    /// Of which builds. Those of AVX2 are asked of a dispatched contender in any.
    pub builds: &'static [Build],
}

impl Bar {
    /// Whether it is asked of contender `id` in this build.
    pub fn asks(&self, id: &str) -> bool {
        let picks_avx2 = id.ends_with(DISPATCHED) && !self.builds.contains(&Build::Avx512);
        self.builds.contains(&Build::THIS) || picks_avx2
    }

    /// Whether it is one of contender `id` of `set` against `rival`. Ours among rivals are made as `id` is.
    pub fn is_between(&self, set: &str, id: &str, rival: &str) -> bool {
        let alike = self.rival.ends_with("/ours") && id.ends_with(DISPATCHED);
        self.set == set && rival.strip_prefix(self.rival) == Some(if alike { DISPATCHED } else { "" })
    }
}

const V3: &[Build] = &[Build::V3];

/// All of them.
#[rustfmt::skip]
pub const BARS: &[Bar] = &[
    Bar { set: "comoments", rival: "comoments/avx2", demand: Demand::Within(1.25), builds: V3 },
    Bar { set: "comoments", rival: "comoments/avx512", demand: Demand::Within(1.5), builds: &[Build::Avx512] },
    Bar { set: "comoments", rival: "comoments/average", demand: Demand::Faster(10.0), builds: V3 },
    Bar { set: "comoments", rival: "comoments/naive-sse2", demand: Demand::Faster(2.0), builds: &[Build::Default, Build::V3] },
    Bar { set: "pixels-1", rival: "pixels-1/average", demand: Demand::Faster(20.0), builds: V3 },
    Bar { set: "pixels-1", rival: "comoments/ours", demand: Demand::Within(1.3), builds: V3 },
    Bar { set: "pixels-3", rival: "pixels-3/average", demand: Demand::Faster(12.0), builds: V3 },
    Bar { set: "pixels-3", rival: "comoments/ours", demand: Demand::Within(1.3), builds: V3 },
    Bar { set: "sums", rival: "sums/raw-sums", demand: Demand::Within(1.5), builds: V3 },
    Bar { set: "ratios-f32", rival: "ratios-f32/divider", demand: Demand::Within(1.15), builds: V3 },
    Bar { set: "ratios-f64", rival: "ratios-f64/divider", demand: Demand::Within(1.15), builds: V3 },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_cleared_from_the_right_side() {
        assert!(Demand::Within(1.25).met_by(1.24) && !Demand::Within(1.25).met_by(1.26));
        assert!(Demand::Faster(10.0).met_by(0.09) && !Demand::Faster(10.0).met_by(0.11));
        assert!(!Demand::Within(1.25).met_by(f64::NAN) && !Demand::Faster(2.0).met_by(f64::NAN));
    }

    #[test]
    fn ours_among_rivals_are_made_alike() {
        let bar = BARS.iter().find(|bar| bar.rival == "comoments/ours").expect("there is one");
        assert!(bar.is_between(bar.set, "ours", "comoments/ours"));
        assert!(bar.is_between(bar.set, "ours-dispatched", "comoments/ours-dispatched"));
        assert!(!bar.is_between(bar.set, "ours", "comoments/ours-dispatched"));
        assert!(!bar.is_between(bar.set, "ours-dispatched", "comoments/ours"));
    }

    #[test]
    fn every_bar_names_a_set_and_a_rival_that_exist() {
        let names: Vec<String> = crate::sets::all(4).iter().map(crate::Measured::name).collect();
        for bar in BARS {
            let ours = format!("{}/ours", bar.set);
            assert!(names.iter().any(|name| name.starts_with(&ours)), "{ours}");
            let machine_may_lack = ["avx2", "avx512", "raw-sums", "divider"].iter().any(|id| bar.rival.ends_with(id));
            assert!(machine_may_lack || names.iter().any(|name| name == bar.rival), "{}", bar.rival);
        }
    }
}
