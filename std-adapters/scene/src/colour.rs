//! What the channels of an image are: three, or one where they are all equal.

use crate::path::Traced;
use glam::Vec3;
use ratiocv_core::{Lanes, Spectrum};
use ratiocv_simd::F32x4;
use ratiocv_simd::functions::Elementary;

/// The colours that a scene is rendered in.
///
/// *Implemented by* `Spectrum<f32, 3>`, linear RGB, and by `f32` for scenes whose channels are all equal;
/// *called by* the path tracer.
pub trait Colour: Lanes<Scalar = f32> + Traced {
    /// The same while a path is traced.
    type OnPath: PathColour;
    /// What is kept of it.
    fn kept(light: Self::OnPath) -> Self;
}

/// The colours that a path is traced in: one SIMD register each.
///
/// *Implemented by* [`F32x4`], RGB and blue once more, and by `f32`; *called by* the path tracer.
pub trait PathColour: Lanes<Scalar = f32> {
    /// Channels that differ.
    const CHANNELS: usize;
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
        self.sum() * (1.0 / Self::CHANNELS as f32)
    }
    /// Every channel times `factor`.
    #[inline(always)]
    #[must_use]
    fn times(self, factor: f32) -> Self {
        self * Self::splat(factor)
    }
}

impl Colour for f32 {
    type OnPath = Self;
    #[inline(always)]
    fn kept(light: Self) -> Self {
        light
    }
}

impl Colour for Spectrum<f32, 3> {
    type OnPath = F32x4;
    #[inline(always)]
    fn kept(light: F32x4) -> Self {
        let [r, g, b, _] = light.to_array();
        Self([r, g, b])
    }
}

impl PathColour for f32 {
    const CHANNELS: usize = 1;
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

impl PathColour for F32x4 {
    const CHANNELS: usize = 3;
    #[inline(always)]
    fn of(rgb: Vec3) -> Self {
        Self::new([rgb.x, rgb.y, rgb.z, rgb.z])
    }
    #[inline(always)]
    fn map(self, change: impl FnMut(f32) -> f32) -> Self {
        Self::new(self.to_array().map(change))
    }
    #[inline(always)]
    fn sum(self) -> f32 {
        let [r, g, b, _] = self.to_array();
        r + g + b
    }
    #[inline(always)]
    fn largest(self) -> f32 {
        let [r, g, b, _] = self.to_array();
        r.max(g).max(b)
    }
    #[inline(always)]
    fn luminance(self) -> f32 {
        let [r, g, b, _] = self.to_array();
        0.212_671 * r + 0.715_160 * g + 0.072_169 * b
    }
    #[inline(always)]
    fn channel(self, channel: usize) -> f32 {
        self.to_array()[channel]
    }
    #[inline(always)]
    fn exponential(self) -> Self {
        let mut x = self.to_array();
        f32::exponentials(&mut x);
        Self::new(x)
    }
}
