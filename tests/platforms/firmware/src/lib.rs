//! What a Cortex-M4F program needs before `main`, and a way to print from QEMU.
#![no_std]

mod machine;
mod measured;
mod start;

pub use machine::{exit, print, print_number};
pub use measured::{Measured, measured};

/// A program that uses `$estimator` and nothing else: draws by themselves and in a batch, a merge, an estimate. It
/// links only if no panic can be reached: what a panic would call does not exist.
#[macro_export]
macro_rules! only {
    ($estimator:expr) => {
        #[panic_handler]
        fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
            unsafe extern "C" {
                fn a_panic_can_be_reached() -> !;
            }
            // SAFETY: never called: a program that refers to it does not link.
            unsafe { a_panic_can_be_reached() }
        }

        /// Called by the reset handler.
        #[unsafe(no_mangle)]
        extern "C" fn program() -> ! {
            use core::hint::black_box;
            use ratiocv_core::moments::{Accumulate, Merge};
            use ratiocv_core::{Draw, Estimator, Integrals, Reads, Spectrum};
            let estimator = $estimator;
            let one = Integrals::<Spectrum<f32, 3>>::ONE;
            let draws = black_box([Draw::new(Spectrum([0.25_f32, 0.5, 0.75]), Spectrum([0.5_f32, 1.0, 1.5])); 64]);
            let empty = estimator.error_bar(&one);
            let mut pixel = empty;
            let adding = $crate::measured(|| (0..16).for_each(|_| draws.iter().for_each(|draw| pixel.add(*draw))));
            let estimating = $crate::measured(|| {
                if let Ok(estimate) = estimator.estimate(&pixel, &one) {
                    black_box((estimate.value, estimate.std_error, estimate.flags(0)));
                }
            });
            let merging = $crate::measured(|| {
                let mut later = empty;
                later.add_batch(black_box(&draws));
                pixel.merge(&later);
                black_box(&pixel);
            });
            for number in [
                size_of_val(&pixel) as u32,
                adding.instructions / 1024,
                estimating.instructions,
                adding.stack.max(estimating.stack).max(merging.stack),
            ] {
                $crate::print_number(number);
                $crate::print(b" ");
            }
            $crate::print(b"\n");
            $crate::exit(true)
        }
    };
}
