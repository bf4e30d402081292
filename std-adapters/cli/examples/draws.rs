//! Prints `examples/draws.csv`: 200 draws of one RGB pixel, lit by a strip of lights x ∈ [0, 1].
//!
//! ```text
//! cargo run -p ratiocv --example draws > std-adapters/cli/examples/draws.csv
//! ```
//!
//! x is drawn with density g(x) = 1/2 + x. Channel k would rather have the density p_k, so that
//! h_k = p_k has the integral 1. The radiance is c_k·p_k(x)·(1 + 0.2(v − 1/2)), v a uniform number
//! that stands for the surface's grain; the lights between 0.45 and 0.5 are hidden.
//!
//! | channel | p_k | c_k | F_k |
//! |---|---|---|---|
//! | r | 0.2 + 1.6x | 8 | 7.616 |
//! | g | 1.5 − x | 5 | 4.74375 |
//! | b | 1.9 − 1.8x | 2 | 1.8955 |

use core::fmt::Write;

/// Numbers in [0, 1) of Knuth's linear congruential generator.
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The file.
pub(crate) fn csv() -> String {
    let mut csv = "f.r,f.g,f.b,h.r,h.g,h.b\n".to_owned();
    let mut uniform = Uniform(1);
    for _ in 0..200 {
        let (u, v) = (uniform.next(), uniform.next());
        // The inverse of G(x) = (x + x²)/2.
        let x = ((1.0 + 8.0 * u).sqrt() - 1.0) / 2.0;
        let pdf = 0.5 + x;
        let visible = if (0.45..0.5).contains(&x) { 0.0 } else { 1.0 + 0.2 * (v - 0.5) };
        let h = [0.2 + 1.6 * x, 1.5 - x, 1.9 - 1.8 * x].map(|p| p / pdf);
        let [r, g, b] = [8.0 * h[0], 5.0 * h[1], 2.0 * h[2]].map(|full| full * visible);
        let _ = writeln!(csv, "{r:.6},{g:.6},{b:.6},{:.6},{:.6},{:.6}", h[0], h[1], h[2]);
    }
    csv
}

fn main() {
    print!("{}", csv());
}
