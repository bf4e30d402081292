//! What a kernel yields.

use crate::Scene;
use crate::colour::Colour;
use crate::light::Weights;
use ratiocv_core::Draw;

/// Samples in a block.
pub const BLOCK: usize = 64;

/// The samples of one block of one pixel, to be used again and again.
///
/// The light of a sample is `plain` + Σ f over the pairs; each pair's h has the integral 1 in every channel.
#[derive(Clone, Debug)]
pub struct Samples<C> {
    /// Light whose h is 1.
    pub plain: [C; BLOCK],
    /// f and h of each term of [`Scene::terms`].
    pub pairs: Vec<[Draw<C>; BLOCK]>,
    /// How many there are.
    pub count: usize,
    pub(super) weights: Weights,
}

impl<C: Colour> Samples<C> {
    /// Room for the samples of `scene`.
    pub fn new(scene: &Scene<C>) -> Self {
        Self {
            plain: [C::ZERO; BLOCK],
            pairs: vec![[Draw::ZERO; BLOCK]; scene.terms().len()],
            count: 0,
            weights: Weights::new(scene.lights.lights.len()),
        }
    }
}
