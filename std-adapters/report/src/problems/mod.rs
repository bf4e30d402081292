//! Problems whose integrals are known exactly. One file each.

mod badly_correlated;
mod curve;
mod importance_sampled;
mod nearly_vanishing;
mod negative_correlation;
mod nested;
mod peaks;
mod population;
mod problem;
mod proportional;
mod signed;
mod sobol;
mod solved;
mod spectrum;
mod three_lights;
mod truncated;
mod uniform;
mod well_correlated;

pub use badly_correlated::BadlyCorrelated;
pub use curve::{Axis, Curve, Role};
pub use importance_sampled::ImportanceSampled;
pub use nearly_vanishing::NearlyVanishing;
pub use negative_correlation::NegativeCorrelation;
pub use nested::Nested;
pub(crate) use nested::{OneLobe, Path, Rgb};
pub use peaks::Peaks;
pub use population::{population, population_of};
pub use problem::{Problem, Visitor};
pub use proportional::Proportional;
pub use signed::Signed;
pub use sobol::Sobol;
pub use solved::{Description, Solved, Source};
pub use spectrum::MeanSpectrum;
pub(crate) use three_lights::LUMINANCE;
pub use three_lights::ThreeLights;
pub use well_correlated::WellCorrelated;
