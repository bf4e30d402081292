//! The problems by id.

use crate::problems::{
    Axis, BadlyCorrelated, Curve, Description, ImportanceSampled, MeanSpectrum, NearlyVanishing, NegativeCorrelation,
    Nested, Peaks, Proportional, Signed, Solved, Source, ThreeLights, WellCorrelated,
};
use ratiocv_core::Lanes;

/// Something to be done with a problem of any type.
///
/// *Implemented by* whoever measures; *called by* [`Problem::visit`].
pub trait Visitor {
    /// What comes of it.
    type Output;
    /// Does it.
    fn visit<S: Solved>(self, problem: &S) -> Self::Output;
}

macro_rules! problems {
    ($($name:ident: $problem:expr,)*) => {
        /// A problem with a known answer, by id.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Problem {
            $(#[doc = concat!("See [`", stringify!($name), "`](crate::problems::", stringify!($name), ").")] $name,)*
        }

        impl Problem {
            /// Every problem, scalar ones first.
            pub fn all() -> impl Iterator<Item = Self> {
                [$(Self::$name),*].into_iter()
            }

            /// Lets `visitor` do its work with the problem's own type.
            pub fn visit<V: Visitor>(self, visitor: V) -> V::Output {
                match self {
                    $(Self::$name => visitor.visit(&$problem),)*
                }
            }

            fn description(self) -> Description {
                const fn of<S: Solved>(_: &S) -> Description {
                    S::DESCRIPTION
                }
                match self {
                    $(Self::$name => of(&$problem),)*
                }
            }
        }
    };
}

problems! {
    WellCorrelated: WellCorrelated,
    BadlyCorrelated: BadlyCorrelated,
    NearlyVanishing: NearlyVanishing,
    NegativeCorrelation: NegativeCorrelation,
    Signed: Signed,
    Proportional: Proportional,
    ImportanceSampled: ImportanceSampled,
    ThreeLights: ThreeLights,
    MeanSpectrum: MeanSpectrum,
    Peaks: Peaks,
    Nested: Nested,
}

impl Problem {
    /// The problem of that id.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::all().find(|problem| problem.id() == id)
    }

    /// Its id: in files, pages and on the command line.
    pub fn id(self) -> &'static str {
        self.description().id
    }

    /// A heading.
    pub fn title(self) -> &'static str {
        self.description().title
    }

    /// f, h, the domain and the sampling density.
    pub fn formula(self) -> &'static str {
        self.description().formula
    }

    /// One line on what it shows.
    pub fn about(self) -> &'static str {
        self.description().why
    }

    /// The names of its channels.
    pub fn channels(self) -> Vec<String> {
        struct Names;
        impl Visitor for Names {
            type Output = Vec<String>;
            fn visit<S: Solved>(self, problem: &S) -> Vec<String> {
                (0..S::Value::LANES).map(|channel| problem.channel(channel)).collect()
            }
        }
        self.visit(Names)
    }

    /// F and H, per channel.
    pub fn integrals(self) -> Vec<(f64, f64)> {
        struct Both;
        impl Visitor for Both {
            type Output = Vec<(f64, f64)>;
            fn visit<S: Solved>(self, problem: &S) -> Vec<(f64, f64)> {
                let (f, h) = (problem.exact(), problem.source().integrals().0[0]);
                (0..S::Value::LANES).map(|channel| (f.get(channel), h.get(channel))).collect()
            }
        }
        self.visit(Both)
    }

    /// f and h over one axis, to be looked at.
    pub fn curves(self) -> (Axis, Vec<Curve>) {
        struct Curves;
        impl Visitor for Curves {
            type Output = (Axis, Vec<Curve>);
            fn visit<S: Solved>(self, problem: &S) -> Self::Output {
                problem.curves()
            }
        }
        self.visit(Curves)
    }
}

#[cfg(test)]
mod tests {
    use super::Problem;

    #[test]
    fn ids_are_kebab_case_and_lead_back() {
        for problem in Problem::all() {
            assert!(problem.id().chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'));
            assert_eq!(Problem::from_id(problem.id()), Some(problem));
            assert!(!problem.title().is_empty() && !problem.formula().is_empty() && !problem.about().is_empty());
            assert_eq!(problem.channels().len(), problem.integrals().len());
        }
        assert_eq!(Problem::from_id("no-such-problem"), None);
    }

    #[test]
    fn curves_are_finite() {
        for problem in Problem::all() {
            let (_, curves) = problem.curves();
            assert!(curves.iter().flat_map(|curve| &curve.points).all(|(x, y)| x.is_finite() && y.is_finite()));
        }
    }
}
