//! What the channels of an image are: three, or one where they are all equal.

use crate::path::Traced;
use glam::Vec3;
use ratiocv_core::{Lanes, Spectrum};
use ratiocv_simd::functions::Elementary;

/// The colours that a scene is rendered in.
///
/// *Implemented by* `Spectrum<f32, 3>`, linear RGB, and by `f32` for scenes whose channels are all equal;
/// *called by* the path tracer.
pub trait Colour: Lanes<Scalar = f32> + Traced {
    /// RGB in this type; of equal channels the first.
    fn of(rgb: Vec3) -> Self;
    /// `change` of every channel.
    #[must_use]
    fn map(self, change: impl FnMut(f32) -> f32) -> Self;
    /// The sum of the channels, in their order.
    fn sum(self) -> f32;
    /// The largest channel; NaN is passed over.
    fn largest(self) -> f32;
    /// 0.212671 R + 0.715160 G + 0.072169 B.
    fn luminance(self) -> f32;
    /// Channel `channel`, which must exist.
    fn channel(self, channel: usize) -> f32;
    /// e^x of every channel.
    #[must_use]
    fn exponential(self) -> Self;
    /// The mean of the channels.
    #[inline(always)]
    fn mean(self) -> f32 {
        self.sum() * (1.0 / Self::LANES as f32)
    }
    /// Every channel times `factor`.
    #[inline(always)]
    #[must_use]
    fn times(self, factor: f32) -> Self {
        self * Self::splat(factor)
    }
}

impl Colour for f32 {
    #[inline(always)]
    fn of(rgb: Vec3) -> Self {
        rgb.x
    }
    #[inline(always)]
    fn map(self, mut change: impl FnMut(f32) -> f32) -> Self {
        change(self)
    }
    #[inline(always)]
    fn sum(self) -> f32 {
        self
    }
    #[inline(always)]
    fn largest(self) -> f32 {
        self
    }
    #[inline(always)]
    fn luminance(self) -> f32 {
        self
    }
    #[inline(always)]
    fn channel(self, _: usize) -> f32 {
        self
    }
    #[inline(always)]
    fn exponential(self) -> Self {
        Elementary::exponential(self)
    }
}

impl Colour for Spectrum<f32, 3> {
    #[inline(always)]
    fn of(rgb: Vec3) -> Self {
        Self([rgb.x, rgb.y, rgb.z])
    }
    #[inline(always)]
    fn map(self, mut change: impl FnMut(f32) -> f32) -> Self {
        let [r, g, b] = self.0;
        Self([change(r), change(g), change(b)])
    }
    #[inline(always)]
    fn sum(self) -> f32 {
        self.0[0] + self.0[1] + self.0[2]
    }
    #[inline(always)]
    fn largest(self) -> f32 {
        self.0[0].max(self.0[1]).max(self.0[2])
    }
    #[inline(always)]
    fn luminance(self) -> f32 {
        0.212_671 * self.0[0] + 0.715_160 * self.0[1] + 0.072_169 * self.0[2]
    }
    #[inline(always)]
    fn channel(self, channel: usize) -> f32 {
        self.0[channel]
    }
    #[inline(always)]
    fn exponential(mut self) -> Self {
        f32::exponentials(&mut self.0);
        self
    }
}
