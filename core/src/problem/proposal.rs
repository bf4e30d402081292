//! Where the draws come from.

use rand_core::Rng;

/// A distribution of points that can be sampled, with its density g.
///
/// *Implemented by* [`Uniform`], [`UniformCube`] and whoever samples better; *called by*
/// [`Problem`](crate::Problem), once per draw.
///
/// # Laws
/// `pdf(&x)` is the density with which `sample` returns x, in the measure of the integrals;
/// positive wherever the integrand or an auxiliary is not 0.
pub trait Proposal {
    /// A point of the domain.
    type Point;
    /// Draws a point.
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Self::Point;
    /// g(x).
    fn pdf(&self, x: &Self::Point) -> f64;
}

/// A proposal may be lent.
impl<P: Proposal> Proposal for &P {
    type Point = P::Point;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> P::Point {
        P::sample(self, rng)
    }
    #[inline]
    fn pdf(&self, x: &P::Point) -> f64 {
        P::pdf(self, x)
    }
}

/// A number in [0, 1) with 53 random bits, every multiple of 2⁻⁵³ equally likely.
///
/// ```
/// use rand_core::SeedableRng;
/// use ratiocv_core::unit_interval;
/// let u = unit_interval(&mut rand_pcg::Pcg64::seed_from_u64(1));
/// assert!((0.0..1.0).contains(&u));
/// ```
#[inline]
pub fn unit_interval<R: Rng + ?Sized>(rng: &mut R) -> f64 {
    // Exact: the product of a 53-bit integer and a power of two.
    (rng.next_u64() >> 11) as f64 * f64::EPSILON / 2.0
}

/// Uniform on [0, 1).
#[derive(Clone, Copy, Debug, Default)]
pub struct Uniform;

impl Proposal for Uniform {
    type Point = f64;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> f64 {
        unit_interval(rng)
    }
    #[inline]
    fn pdf(&self, _: &f64) -> f64 {
        1.0
    }
}

/// Uniform on [0, 1)ᴰ.
#[derive(Clone, Copy, Debug, Default)]
pub struct UniformCube<const D: usize>;

impl<const D: usize> Proposal for UniformCube<D> {
    type Point = [f64; D];
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> [f64; D] {
        core::array::from_fn(|_| unit_interval(rng))
    }
    #[inline]
    fn pdf(&self, _: &[f64; D]) -> f64 {
        1.0
    }
}
