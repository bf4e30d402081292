//! Evenly spread points in place of random ones.

use core::convert::Infallible;
use rand_core::TryRng;

/// Hands out the coordinates of a rank-1 lattice of [`Lattice::POINTS`] points as if they were
/// random: point after point, `DIMENSIONS` numbers each.
///
/// The same code that draws for a measurement then integrates its own law to many digits. The
/// generating vector is that of Kuo's and Nuyens' embedded lattice rules (`exod2_base2_m20`); each
/// coordinate is shifted by half a step and folded by the tent map, which makes smooth functions
/// periodic.
#[derive(Clone, Copy, Debug)]
pub struct Lattice<const DIMENSIONS: usize> {
    point: u64,
    coordinate: usize,
}

const LOG_POINTS: u32 = 20;
const GENERATOR: [u64; 8] = [1, 182_667, 469_891, 498_753, 110_745, 446_979, 250_185, 118_627];

impl<const DIMENSIONS: usize> Lattice<DIMENSIONS> {
    /// The number of points; after them it starts over.
    pub const POINTS: u64 = 1 << LOG_POINTS;

    /// From point number `point` on.
    pub const fn starting_at(point: u64) -> Self {
        const { assert!(DIMENSIONS >= 1 && DIMENSIONS <= GENERATOR.len()) };
        Self { point, coordinate: 0 }
    }

    fn next(&mut self) -> u64 {
        let step = self.point.wrapping_mul(GENERATOR[self.coordinate]) << (u64::BITS - LOG_POINTS);
        let shifted = step | 1 << (u64::BITS - LOG_POINTS - 1);
        self.coordinate += 1;
        if self.coordinate == DIMENSIONS {
            self.coordinate = 0;
            self.point += 1;
        }
        // 1 − |2u − 1|.
        (if shifted >> (u64::BITS - 1) == 0 { shifted } else { !shifted }) << 1
    }
}

impl<const DIMENSIONS: usize> TryRng for Lattice<DIMENSIONS> {
    type Error = Infallible;
    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok((self.next() >> 32) as u32)
    }
    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(self.next())
    }
    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        for bytes in bytes.chunks_mut(8) {
            bytes.copy_from_slice(&self.next().to_le_bytes()[..bytes.len()]);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Lattice;
    use ratiocv_core::unit_interval;

    #[test]
    fn a_smooth_product_is_integrated_to_six_digits() {
        let mut lattice = Lattice::<5>::starting_at(0);
        let mut sum = 0.0;
        for _ in 0..Lattice::<5>::POINTS {
            // ∫ of each factor is 1.
            sum += (0..5).fold(1.0, |product, _| product * (0.5 + unit_interval(&mut lattice)));
        }
        let mean = sum / Lattice::<5>::POINTS as f64;
        assert!((mean - 1.0).abs() <= 1e-6, "{mean}");
    }

    #[test]
    fn a_lattice_can_start_anywhere() {
        let mut whole = Lattice::<2>::starting_at(0);
        for _ in 0..2 * 1000 {
            unit_interval(&mut whole);
        }
        assert_eq!(unit_interval(&mut whole), unit_interval(&mut Lattice::<2>::starting_at(1000)));
    }
}
