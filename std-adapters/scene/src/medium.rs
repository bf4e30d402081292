//! Homogeneous media: intervals of a ray.
//!
//! A medium fills a convex shape whose bound is not there for light, so that it needs no steps from bound to bound
//! and no offsets, and overlapping media add up. What is sampled is a distance; what only absorbs is not
//! sampled at all.

use crate::colour::PathColour;
use crate::description::{Geometry, Material, Shape};
use crate::error::SceneError;
use crate::geometry::{Beam, Cube, Interval, Ray, Sphere};
use crate::material::within;
use crate::planted::planted;
use crate::random::Random;
use ratiocv_simd::functions::Elementary;

/// What a medium fills.
#[derive(Clone, Copy, Debug)]
enum Bound {
    Sphere(Sphere),
    Cube(Cube),
}

/// A medium in its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Filled<C> {
    bound: Bound,
    extinction: C,
    /// Extinction times albedo.
    scattering: C,
    scatters: bool,
}

/// What became of a ray on its way through media.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage<C> {
    /// Where it was scattered; infinite if it was not.
    pub(crate) t: f32,
    /// f over the density of each channel, and that density: of being scattered at `t` or of passing.
    pub(crate) over_density: C,
    pub(crate) density: C,
}

impl<C: PathColour> Filled<C> {
    /// What fills shape `i`, if anything does.
    pub(crate) fn new(shape: &Shape, i: usize) -> Result<Option<Self>, SceneError> {
        let Some(medium) = shape.medium else { return Ok(None) };
        let bound = match &shape.geometry {
            Geometry::Sphere { center, radius } => Sphere::new(*center, *radius, false).map(Bound::Sphere),
            Geometry::Cube(to_world) => Cube::new(to_world, false).map(Bound::Cube),
            _ => return Err(SceneError::Medium(i)),
        };
        if shape.surface.material != Material::Null {
            return Err(SceneError::Medium(i));
        }
        if !within(medium.extinction, f32::MAX) || !within(medium.albedo, 1.0) {
            return Err(SceneError::Value(i));
        }
        let scattering = medium.extinction * medium.albedo;
        Ok(Some(Self {
            bound: bound.ok_or(SceneError::Shape(i))?,
            extinction: C::of(medium.extinction),
            scattering: C::of(scattering),
            scatters: scattering != glam::Vec3::ZERO,
        }))
    }

    /// Whether any ray of the beam may pass through it.
    #[inline(always)]
    pub(crate) fn is_met_by(&self, beam: &Beam) -> bool {
        let distances = match &self.bound {
            Bound::Sphere(sphere) => sphere.distances(beam),
            Bound::Cube(cube) => cube.distances(beam),
        };
        distances.iter().fold(false, |is_met, t| is_met | t.is_finite())
    }

    /// Where the ray is inside, up to `t`.
    #[inline(always)]
    fn interval(&self, ray: &Ray, t: f32) -> Interval {
        let Interval(near, far) = match &self.bound {
            Bound::Sphere(sphere) => sphere.interval(ray),
            Bound::Cube(cube) => cube.interval(ray),
        };
        Interval(near.max(0.0), far.min(t))
    }
}

/// Tr = exp(−Σ extinction·overlap) along `ray` up to `t`.
#[inline(always)]
pub(crate) fn transmittance<C: PathColour>(media: &[Filled<C>], ray: &Ray, t: f32) -> C {
    let depth = |sum: C, medium: &Filled<C>| sum + medium.extinction.times(-medium.interval(ray, t).length());
    media.iter().fold(C::ZERO, depth).exponential()
}

/// Samples where `ray`, which would go on to `t`, is scattered, by channel `channel`'s extinction: a distance in each
/// medium that scatters, of which the least counts.
#[inline(always)]
pub(crate) fn pass<C: PathColour>(
    media: &[Filled<C>],
    ray: &Ray,
    t: f32,
    channel: usize,
    random: &mut Random,
) -> Passage<C> {
    let mut scattered = f32::INFINITY;
    // Of the last medium that scatters, in most scenes the only one: not worked out again below.
    let (mut last, mut known) = (usize::MAX, Interval(0.0, 0.0));
    for (i, medium) in media.iter().enumerate() {
        if medium.scatters {
            (last, known) = (i, medium.interval(ray, t));
            let Interval(near, far) = known;
            let u = random.uniform();
            if near < far {
                let distance = near - (1.0 - u).logarithm() / medium.extinction.channel(channel);
                if distance < far {
                    scattered = scattered.min(distance);
                }
            }
        }
    }
    let end = scattered.min(t);
    let [mut sampled, mut absorbed] = [C::ZERO; 2];
    let [mut extinction, mut scattering] = [C::ZERO; 2];
    let mut absorbs = false;
    for (i, medium) in media.iter().enumerate() {
        let interval = if i == last { known } else { medium.interval(ray, t) };
        let depth = medium.extinction.times(-Interval(interval.0, interval.1.min(end)).length());
        if medium.scatters {
            sampled = sampled + depth;
            // The very medium that scatters is here whatever the end of its interval is rounded to.
            if interval.0 <= scattered && scattered < interval.1 {
                extinction = extinction + medium.extinction;
                scattering = scattering + medium.scattering;
            }
        } else {
            absorbed = absorbed + depth;
            absorbs = true;
        }
    }
    // e⁰ = 1 needs no working out.
    let absorbed = if absorbs { absorbed.exponential() } else { C::ONE };
    let passed = if last < media.len() { sampled.exponential() } else { C::ONE };
    if scattered.is_finite() {
        let albedo = C::select(C::ZERO.lt(extinction), scattering / extinction, C::ZERO);
        let density = passed * planted!("medium_density_without_extinction": extinction, C::ONE);
        Passage { t: scattered, over_density: absorbed * albedo, density }
    } else {
        Passage { t: f32::INFINITY, over_density: absorbed, density: passed }
    }
}
