//! Materials: what becomes of light at a surface.

mod conductor;
mod surface;

pub(crate) use conductor::Lobes;
pub(crate) use surface::{Surface, within};
