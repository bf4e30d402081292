//! What light comes from, sampled from a point.

use crate::geometry::{Cube, Rectangle, Solid, Sphere, Triangle};
use crate::light::towards::{Towards, cone};
use crate::planted::planted;
use core::f32::consts::PI;
use glam::Vec3;

/// The shape of a light.
#[derive(Clone, Debug)]
pub(crate) enum Emitter {
    Sphere(Sphere),
    Rectangle {
        rectangle: Rectangle,
        area: f32,
    },
    Cube {
        cube: Cube,
        area: f32,
    },
    /// Triangles with the area up to each of them.
    Mesh {
        triangles: Vec<Triangle>,
        areas: Vec<f32>,
    },
    Point(Vec3),
}

impl Emitter {
    /// Of a shape that was put into a geometry as number `shape`, with its triangles.
    pub(crate) fn new(solid: Solid, shape: u32, triangles: &[Triangle]) -> Self {
        match solid {
            Solid::Sphere(sphere) => Self::Sphere(sphere),
            Solid::Rectangle(rectangle) => Self::Rectangle { area: rectangle.area(), rectangle },
            Solid::Cube(cube) => Self::Cube { area: cube.area(), cube },
            Solid::Mesh => {
                let triangles: Vec<_> = triangles.iter().filter(|triangle| triangle.shape == shape).copied().collect();
                let mut sum = 0.0;
                let areas = triangles.iter().map(|triangle| {
                    sum += triangle.area();
                    sum
                });
                Self::Mesh { areas: areas.collect(), triangles }
            }
        }
    }

    /// The area that is seen, on average over the directions that see any; 1 for a point.
    pub(crate) fn seen_area(&self) -> f32 {
        match self {
            Self::Sphere(sphere) => PI * sphere.radius * sphere.radius,
            Self::Rectangle { area, .. } => *area,
            Self::Cube { area, .. } => area / 4.0,
            Self::Mesh { areas, .. } => areas.last().copied().unwrap_or(0.0) / 4.0,
            Self::Point(_) => 1.0,
        }
    }

    /// Power over radiance (over intensity, of a point) and [`seen_area`](Self::seen_area).
    pub(crate) fn power(&self) -> f32 {
        if let Self::Rectangle { .. } = self { PI } else { 4.0 * PI }
    }

    /// A sphere about all of it.
    pub(crate) fn bound(&self) -> (Vec3, f32) {
        match self {
            Self::Sphere(sphere) => (sphere.center, sphere.radius),
            Self::Rectangle { rectangle, .. } => {
                let [u, v] = rectangle.edges;
                (rectangle.center, (u + v).length().max((u - v).length()))
            }
            Self::Cube { cube, .. } => cube.bound(),
            Self::Mesh { triangles, .. } => {
                let corners = || triangles.iter().flat_map(Triangle::corners);
                let lowest = corners().fold(Vec3::MAX, Vec3::min);
                let center = (lowest + corners().fold(Vec3::MIN, Vec3::max)) * 0.5;
                (center, corners().map(|corner| (corner - center).length()).fold(0.0, f32::max))
            }
            Self::Point(position) => (*position, 0.0),
        }
    }

    /// The normal of its plane, if it has one: it is dark behind it.
    pub(crate) fn plane(&self) -> Option<Vec3> {
        if let Self::Rectangle { rectangle, .. } = self { Some(rectangle.normal) } else { None }
    }

    pub(crate) const fn is_point(&self) -> bool {
        matches!(self, Self::Point(_))
    }

    /// Centre and radius of a sphere that shines outwards.
    #[inline(always)]
    pub(crate) const fn ball(&self) -> Option<(Vec3, f32)> {
        match self {
            Self::Sphere(sphere) if sphere.side > 0.0 => Some((sphere.center, sphere.radius)),
            _ => None,
        }
    }

    /// Whether it can hide parts of itself.
    pub(crate) const fn hides_itself(&self) -> bool {
        matches!(self, Self::Mesh { .. })
    }

    /// A direction to it from `from`; `None`: it shows its
    /// back. Spheres are sampled by the cone in which they are seen, from the inside and on them by area; the
    /// others by area.
    #[inline(always)]
    pub(crate) fn sample(&self, from: Vec3, u: [f32; 2]) -> Option<Towards> {
        match self {
            Self::Sphere(sphere) => Self::sample_sphere(sphere, from, u),
            Self::Rectangle { rectangle, area } => {
                Towards::to_area(from, (rectangle.sample(u), rectangle.normal), *area)
            }
            Self::Cube { cube, area } => Towards::to_area(from, cube.sample(u), *area),
            Self::Mesh { triangles, areas } => Self::sample_mesh(triangles, areas, from, u),
            Self::Point(position) => {
                let to = *position - from;
                let square = to.dot(to);
                let distance = square.sqrt();
                (distance > 0.0).then(|| Towards {
                    direction: to / distance,
                    distance,
                    inverse_pdf: 1.0 / planted!("point_by_distance": square, distance),
                })
            }
        }
    }

    #[inline(always)]
    fn sample_sphere(sphere: &Sphere, from: Vec3, [u, v]: [f32; 2]) -> Option<Towards> {
        if sphere.side < 0.0 {
            // By area: from a point of the sphere itself, cos·cos/distance² is the same everywhere.
            let outward = crate::frame::uniform_direction([u, v]);
            let area = 4.0 * PI * sphere.radius * sphere.radius;
            return Towards::to_area(from, (sphere.center + outward * sphere.radius, -outward), area);
        }
        let towards = Towards::to_sphere(from, (sphere.center, sphere.radius), [u, v]);
        (towards.inverse_pdf > 0.0).then_some(towards)
    }

    fn sample_mesh(triangles: &[Triangle], areas: &[f32], from: Vec3, [u, v]: [f32; 2]) -> Option<Towards> {
        let area = *areas.last()?;
        let place = u * area;
        let i = areas.partition_point(|end| *end <= place).min(areas.len() - 1);
        let before = if i == 0 { 0.0 } else { areas[i - 1] };
        let u = ((place - before) / (areas[i] - before)).clamp(0.0, 1.0);
        Towards::to_area(from, triangles[i].sample([u, v]), area)
    }

    /// 1 over the density with which [`sample`](Self::sample) chooses the direction of a point of it at
    /// `distance` where its normal's cosine is `cos` > 0. Of a point light infinite: it is never met.
    #[inline(always)]
    pub(crate) fn inverse_pdf(&self, from: Vec3, distance: f32, cos: f32) -> f32 {
        let by_area = |area: f32| cos * area / (distance * distance);
        match self {
            Self::Sphere(sphere) if sphere.side < 0.0 => by_area(4.0 * PI * sphere.radius * sphere.radius),
            Self::Sphere(sphere) => {
                let to_center = sphere.center - from;
                let cap = cone(sphere.radius, to_center.dot(to_center));
                if cap > 0.0 { planted!("cone_of_the_hemisphere": 2.0 * PI * cap, 2.0 * PI) } else { f32::INFINITY }
            }
            Self::Rectangle { area, .. } | Self::Cube { area, .. } => by_area(*area),
            Self::Mesh { areas, .. } => by_area(areas.last().copied().unwrap_or(0.0)),
            Self::Point(_) => f32::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use glam::Affine3A;

    /// Means of 1/pdf and of cos²/pdf about the direction to the middle, and that `inverse_pdf` of the point met
    /// is that of the sample.
    fn solid_angle(emitter: &Emitter, from: Vec3, n: u32) -> f64 {
        let mut random = Random::new(4, [0, 0], 0);
        let mut sum = 0.0;
        for _ in 0..n {
            if let Some(towards) = emitter.sample(from, random.uniforms()) {
                sum += f64::from(towards.inverse_pdf);
                assert!((towards.direction.length() - 1.0).abs() <= 1e-5 && towards.distance > 0.0);
            }
        }
        sum / f64::from(n)
    }

    #[test]
    fn inverse_densities_average_to_the_solid_angle() {
        let sphere = Sphere::new(Vec3::new(0.0, 0.0, 3.0), 1.0, false).expect("a sphere");
        // 2π(1 − cos) with sin = 1/3, exactly: the density is uniform.
        let right = core::f64::consts::TAU * (1.0 - libm::sqrt(8.0 / 9.0));
        let ours = solid_angle(&Emitter::Sphere(sphere), Vec3::ZERO, 100);
        assert!((ours - right).abs() <= 1e-5 * right, "{ours} {right}");
        // From its own surface, cos/distance² averages to 1/(2r)·mean(1/distance) = 1/(2r²): half of all directions.
        let inside = Emitter::Sphere(Sphere::new(Vec3::ZERO, 2.0, true).expect("a sphere"));
        let from = Vec3::new(0.0, 0.0, 2.0);
        let ours = solid_angle(&inside, from, 1_000_000);
        // 1/pdf = 4πr²·cos/d² = 2πr/d, and 1/d² has a logarithmic tail: N = 10⁶, σ ≈ 6, 6.5σ/√N = 0.04.
        assert!((ours - core::f64::consts::TAU).abs() <= 0.04, "{ours}");
        // A square seen from straight below its middle: 4 asin(1/(1 + h²)) = 4 asin(½) at h = 1.
        let down = Affine3A::from_axis_angle(Vec3::X, core::f32::consts::PI);
        let square = Affine3A::from_translation(Vec3::Z) * down;
        let emitter = |to_world: &Affine3A| {
            let rectangle = Rectangle::new(to_world, false).expect("a square");
            Emitter::Rectangle { area: rectangle.area(), rectangle }
        };
        let right = 4.0 * libm::asin(0.5);
        // σ < 1.2: N = 10⁵, 6.5σ/√N = 0.025.
        let ours = solid_angle(&emitter(&square), Vec3::ZERO, 100_000);
        assert!((ours - right).abs() <= 0.025, "{ours} {right}");
        assert_eq!(solid_angle(&emitter(&Affine3A::from_translation(Vec3::Z)), Vec3::ZERO, 100), 0.0);
        // A cube [−1, 1]³ from 2 away: it shows its nearest face alone, at h = 1.
        let cube = Cube::new(&Affine3A::from_translation(2.0 * Vec3::Z), false).expect("a cube");
        let ours = solid_angle(&Emitter::Cube { area: cube.area(), cube }, Vec3::ZERO, 600_000);
        assert!((ours - right).abs() <= 0.03, "{ours} {right}");
    }

    #[test]
    fn what_is_met_has_the_density_that_it_was_sampled_with() {
        let mut random = Random::new(5, [0, 0], 0);
        let to_world = Affine3A::from_translation(Vec3::new(0.3, 2.0, -0.4));
        let rectangle = Rectangle::new(&to_world, true).expect("a square");
        let cube = Cube::new(&to_world, false).expect("a cube");
        let sphere = Sphere::new(Vec3::Y, 0.3, false).expect("a sphere");
        let from = Vec3::new(0.1, -0.2, -3.0);
        for _ in 0..1000 {
            let u = random.uniforms();
            for emitter in [
                Emitter::Sphere(sphere),
                Emitter::Rectangle { rectangle, area: rectangle.area() },
                Emitter::Cube { cube, area: cube.area() },
            ] {
                let Some(towards) = emitter.sample(from, u) else { continue };
                let position = from + towards.direction * towards.distance;
                let normal = match &emitter {
                    Emitter::Sphere(sphere) => sphere.point(position).1,
                    Emitter::Rectangle { rectangle, .. } => rectangle.normal,
                    _ => cube.normal(position),
                };
                let again = emitter.inverse_pdf(from, towards.distance, -normal.dot(towards.direction));
                assert!((again - towards.inverse_pdf).abs() <= 1e-4 * again, "{again} {towards:?}");
            }
        }
    }
}
