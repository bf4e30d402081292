//! What a comparison of run times cannot show. One file each: what is measured, and the numbers.
//!
//! ```no_run
//! let report = ratiocv_report::run(&ratiocv_report::Options::default(), &())?;
//! if let Some(exhibits) = &report.exhibits {
//!     println!("the bias of a ratio inside an integral tends to {:?}", exhibits.nested.limit);
//! }
//! # Ok::<(), ratiocv_report::Error>(())
//! ```

mod floor;
mod nested;
mod replicates;
mod shadow;
mod two_techniques;

pub use nested::{Bias, NestedBias, NestedCurve};
pub use shadow::{REACH, Shaded, Shadow};
pub use two_techniques::{Combination, TwoTechniquesMse};

use crate::measure::Options;
use rayon::ThreadPool;

/// The exhibits of a report.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Exhibits {
    /// A ratio inside an integral.
    pub nested: NestedBias,
    /// An auxiliary that ignores shadows.
    pub shadow: Shadow,
    /// Two auxiliaries together.
    pub two_techniques: TwoTechniquesMse,
}

impl Exhibits {
    /// How many steps [`measure`](Exhibits::measure) reports.
    pub(crate) const STEPS: usize = 3;

    /// Measures them all, on the threads of `pool`; `doing` is told what comes next.
    pub(crate) fn measure(options: &Options, pool: &ThreadPool, doing: &dyn Fn(&str)) -> Self {
        doing("exhibits: nested ratios");
        let nested = pool.install(|| NestedBias::measure(options));
        doing("exhibits: shadows");
        let shadow = pool.install(|| Shadow::measure(options));
        doing("exhibits: two techniques");
        let two_techniques = pool.install(|| TwoTechniquesMse::measure(options));
        Self { nested, shadow, two_techniques }
    }
}
