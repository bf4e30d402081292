//! Error against run time on a scene: every method, a reference, and images at equal time.

mod error;
mod measure;
mod reference;

pub use error::SceneFault;
pub use measure::{Curve, ScenePoint, SceneReport, SceneSettings, Shown, run};
pub use reference::Reference;
