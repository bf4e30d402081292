//! One kernel per combination of needs.

use crate::Scene;
use crate::colour::Colour;
use crate::needs::Needs;
use crate::path::Samples;
use crate::path::direct::Direct;
use crate::path::kernel::{Block, Paths};
use ratiocv_core::Spectrum;
use ratiocv_simd::at_best_level;

/// Traces a block of samples.
pub(crate) type Kernel<C> = fn(&Scene<C>, Block, &mut Samples<C>);

fn trace<
    C: Colour,
    const AUXILIARY: bool,
    const MEDIA: bool,
    const CONDUCTORS: bool,
    const LIGHTS: bool,
    const SCATTERING: bool,
>(
    scene: &Scene<C>,
    block: Block,
    samples: &mut Samples<C>,
) {
    // One channel has no auxiliaries, and needs no kernels with them.
    if !AUXILIARY || C::LANES > 1 {
        at_best_level(Paths::<C, AUXILIARY, MEDIA, CONDUCTORS, LIGHTS, SCATTERING> { scene, block, samples });
    }
}

fn trace_direct<C: Colour, const AUXILIARY: bool>(scene: &Scene<C>, block: Block, samples: &mut Samples<C>) {
    if !AUXILIARY || C::LANES > 1 {
        at_best_level(Direct::<C, AUXILIARY> { scene, block, samples });
    }
}

/// The kernel of a scene: 18 for RGB, 9 for one channel.
///
/// Techniques and conductors come in four combinations, because others cost next to nothing more in the kernel
/// with both.
fn kernel<C: Colour>(needs: &Needs) -> Kernel<C> {
    if needs.direct_alone() {
        return if needs.auxiliary { trace_direct::<C, true> } else { trace_direct::<C, false> };
    }
    macro_rules! select {
        ($($auxiliary:literal $media:literal)*) => {
            match (needs.auxiliary, needs.media, needs.conductors, needs.light_sampling, needs.scattering) {
                $(
                    ($auxiliary, $media, false, true, false) => trace::<C, $auxiliary, $media, false, true, false>,
                    ($auxiliary, $media, false, false, _) => trace::<C, $auxiliary, $media, false, false, true>,
                    ($auxiliary, $media, true, false, _) => trace::<C, $auxiliary, $media, true, false, true>,
                    ($auxiliary, $media, _, true, _) => trace::<C, $auxiliary, $media, true, true, true>,
                )*
            }
        };
    }
    select!(false false  false true  true false  true true)
}

/// The kernel that leaves nothing out.
fn everything<C: Colour>() -> Kernel<C> {
    if C::LANES > 1 { trace::<C, true, true, true, true, true> } else { trace::<C, false, true, true, true, true> }
}

/// Colours that kernels are compiled for, in this crate: generic to the end, every crate that renders would compile
/// all of them again, for minutes. It also keeps [`Colour`] from being implemented elsewhere.
pub trait Traced: Sized {
    /// The kernel that the scene needs.
    fn kernel(needs: &Needs) -> Kernel<Self>
    where
        Self: Colour;
    /// The kernel that leaves nothing out.
    fn everything() -> Kernel<Self>
    where
        Self: Colour;
}

macro_rules! traced {
    ($($colour:ty)*) => {$(
        impl Traced for $colour {
            fn kernel(needs: &Needs) -> Kernel<Self> {
                kernel(needs)
            }
            fn everything() -> Kernel<Self> {
                everything()
            }
        }
    )*};
}

traced!(f32 Spectrum<f32, 3>);
