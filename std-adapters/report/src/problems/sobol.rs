//! Evenly spread points in place of random ones.

use core::convert::Infallible;
use rand_core::TryRng;

/// Hands out the coordinates of the first [`Sobol::POINTS`] points of Sobol's sequence as if they were
/// random numbers: point after point, so many numbers each.
///
/// The same code that draws for a measurement then integrates its own law, to five digits or more.
/// Direction numbers by Joe and Kuo (2008); every coordinate is shifted by half a step, away from 0.
#[derive(Clone, Copy, Debug)]
pub struct Sobol {
    point: u64,
    coordinate: usize,
    dimensions: usize,
}

const LOG_POINTS: usize = 20;

/// Degree, inner coefficients and first direction numbers of a primitive polynomial.
type Polynomial = (usize, u64, [u64; 3]);

/// Those of the second to the fifth coordinate; the first is van der Corput's sequence.
const POLYNOMIALS: [Polynomial; 4] = [(1, 0, [1, 0, 0]), (2, 1, [1, 3, 0]), (3, 1, [1, 3, 1]), (3, 2, [1, 1, 1])];

/// What each bit of a point's number contributes to each coordinate, as a fraction of 2⁶⁴.
const DIRECTIONS: [[u64; LOG_POINTS]; 5] = {
    let mut directions = [[0; LOG_POINTS]; 5];
    let mut bit = 0;
    while bit < LOG_POINTS {
        directions[0][bit] = 1 << (63 - bit);
        bit += 1;
    }
    let mut coordinate = 1;
    while coordinate < 5 {
        let (degree, inner, first) = POLYNOMIALS[coordinate - 1];
        let mut bit = 0;
        while bit < LOG_POINTS {
            directions[coordinate][bit] = if bit < degree {
                first[bit] << (63 - bit)
            } else {
                let earlier = directions[coordinate][bit - degree];
                let mut direction = earlier ^ (earlier >> degree);
                let mut k = 1;
                while k < degree {
                    if inner >> (degree - 1 - k) & 1 == 1 {
                        direction ^= directions[coordinate][bit - k];
                    }
                    k += 1;
                }
                direction
            };
            bit += 1;
        }
        coordinate += 1;
    }
    directions
};

impl Sobol {
    /// The number of points; after them it starts over.
    pub const POINTS: u64 = 1 << LOG_POINTS;

    /// From point number `point` on, in `dimensions` dimensions; panics for more than 5 of them.
    pub const fn starting_at(point: u64, dimensions: usize) -> Self {
        assert!(dimensions >= 1 && dimensions <= DIRECTIONS.len(), "Sobol's sequence is kept for 1 to 5 dimensions");
        Self { point, coordinate: 0, dimensions }
    }

    fn next(&mut self) -> u64 {
        let mut bits = self.point % Self::POINTS;
        let mut number = 1 << (63 - LOG_POINTS);
        while bits != 0 {
            number ^= DIRECTIONS[self.coordinate][bits.trailing_zeros() as usize];
            bits &= bits - 1;
        }
        self.coordinate += 1;
        if self.coordinate == self.dimensions {
            self.coordinate = 0;
            self.point += 1;
        }
        number
    }
}

impl TryRng for Sobol {
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
    use super::Sobol;
    use ratiocv_core::unit_interval;

    #[test]
    fn the_first_points_are_sobols() {
        // scipy.stats.qmc.Sobol(5, scramble=False), SciPy 1.17, in binary instead of Gray order.
        let right = [[0.0; 5], [0.5; 5], [0.25, 0.75, 0.75, 0.75, 0.25], [0.75, 0.25, 0.25, 0.25, 0.75]];
        let mut points = Sobol::starting_at(0, 5);
        for point in right {
            for coordinate in point {
                let half_a_step = 0.5 / Sobol::POINTS as f64;
                assert_eq!(unit_interval(&mut points), coordinate + half_a_step);
            }
        }
    }

    #[test]
    fn a_smooth_product_is_integrated_to_six_digits() {
        let mut points = Sobol::starting_at(0, 5);
        let mut sum = 0.0;
        for _ in 0..Sobol::POINTS {
            // ∫ of each factor is 1.
            sum += (0..5).fold(1.0, |product, _| product * (0.5 + unit_interval(&mut points)));
        }
        let mean = sum / Sobol::POINTS as f64;
        assert!((mean - 1.0).abs() <= 1e-6, "{mean}");
    }

    #[test]
    fn it_can_start_anywhere() {
        let mut whole = Sobol::starting_at(0, 2);
        for _ in 0..2 * 1000 {
            unit_interval(&mut whole);
        }
        assert_eq!(unit_interval(&mut whole), unit_interval(&mut Sobol::starting_at(1000, 2)));
    }
}
