//! Kernels at the level of the machine, not of the build.
//!
//! A default build for x86-64 uses SSE2 alone, half the width of what nearly every machine has. Arrays of
//! lanes need no other source for it, only another compilation: generic code that is inlined into a
//! function compiled for AVX2 becomes AVX2 code. Bits do not change: no level fuses operations.

use core::fmt;
use ratiocv_core::moments::Accumulate;

/// Something to be done at the best level.
///
/// *Implemented by* callers with a hot loop of their own; *called by* [`at_best_level`].
///
/// # Laws
/// The result must not depend on the level; nothing in this workspace does.
///
/// # Implementing
/// Mark `run`, and what its loops call, `#[inline(always)]`: what is not inlined stays at the level of the
/// build. The accumulators' `add_batch`, `add_from` and `add_slices` are.
pub trait Work {
    /// What comes of it.
    type Output;
    /// Does it.
    fn run(self) -> Self::Output;
}

/// Instructions that kernels may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// What the target promises: SSE2 on x86-64, NEON on AArch64, nothing on a microcontroller.
    Target,
    /// AVX2 (x86-64-v3).
    Avx2,
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Target => "the target's own instructions",
            Self::Avx2 => "AVX2",
        })
    }
}

impl Level {
    /// The level that [`at_best_level`] runs at: with feature `std`, what the machine can do; without,
    /// what the build may assume.
    ///
    /// ```
    /// println!("kernels use {}", ratiocv_simd::Level::best());
    /// ```
    pub fn best() -> Self {
        struct Which;
        impl Work for Which {
            type Output = Level;
            #[inline(always)]
            fn run(self) -> Level {
                Level::best_of_target()
            }
        }
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("bmi2") {
            return Self::Avx2;
        }
        at_best_level(Which)
    }

    const fn best_of_target() -> Self {
        if cfg!(target_feature = "avx2") { Self::Avx2 } else { Self::Target }
    }
}

/// Runs `work` with the best instructions that the machine has (feature `std`; without it, with those of the
/// build). The same bits either way.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments, Moments}, Draw, Spectrum};
/// use ratiocv_simd::{at_best_level, Work};
/// type Lanes = Spectrum<f32, 16>;
/// /// Draws that are made and added at AVX2 speed.
/// struct Trace<'a>(&'a mut Comoments<Lanes>);
/// impl Work for Trace<'_> {
///     type Output = ();
///     #[inline(always)]
///     fn run(self) {
///         let mut x = Lanes::splat(0.0);
///         self.0.add_from(4096, || {
///             x = x + Lanes::splat(0.001);
///             Draw::new(x * x, x)
///         });
///     }
/// }
/// # use ratiocv_core::Lanes as _;
/// let mut moments = Comoments::default();
/// at_best_level(Trace(&mut moments));
/// assert_eq!(moments.count(), 4096);
/// ```
#[cfg_attr(
    feature = "std",
    multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"), dispatcher = "direct")
)]
pub fn at_best_level<W: Work>(work: W) -> W::Output {
    work.run()
}

/// [`Accumulate::add_batch`] at the best level.
///
/// ```
/// use ratiocv_core::{moments::{Comoments, Moments}, Draw, Spectrum};
/// let draws = [Draw::new(Spectrum([1.0_f32; 16]), Spectrum([0.5; 16])); 256];
/// let mut moments = Comoments::<Spectrum<f32, 16>>::default();
/// ratiocv_simd::add_batch(&mut moments, &draws);
/// assert_eq!(moments.count(), 256);
/// ```
pub fn add_batch<D, M: Accumulate<D>>(moments: &mut M, draws: &[D]) {
    struct Batch<'a, D, M>(&'a mut M, &'a [D]);
    impl<D, M: Accumulate<D>> Work for Batch<'_, D, M> {
        type Output = ();
        #[inline(always)]
        fn run(self) {
            self.0.add_batch(self.1);
        }
    }
    at_best_level(Batch(moments, draws));
}
