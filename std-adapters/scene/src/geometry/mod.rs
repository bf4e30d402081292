//! Shapes, sorted by kind into arrays: what a ray meets first, and whether it meets anything. Spheres and
//! rectangles are searched eight at a time.
//!
//! A ray knows the shape that it leaves. From a point of a convex shape, [t₀, t₁] is [0, t₀ + t₁] or empty
//! whatever rounding says, and a plane is not met again at all: no offsets that would have to be larger than
//! rounding and smaller than what is to be seen. Only triangles need a least distance, from other triangles.

mod beam;
mod columns;
mod cube;
mod mesh;
mod nearest;
mod packs;
mod rectangle;
mod segments;
mod sphere;
#[cfg(test)]
mod tests;

pub(crate) use beam::Beam;
pub(crate) use columns::Columns;
pub(crate) use cube::Cube;
pub(crate) use mesh::{Meshes, Triangle};
pub(crate) use nearest::Nearest;
pub(crate) use rectangle::Rectangle;
pub(crate) use segments::Segments;
pub(crate) use sphere::Sphere;

use packs::{Rectangles, Spheres, closest_in, occluded_by, packs_of};

use crate::description;
use crate::error::SceneError;
use glam::Vec3;

/// The number of no shape and of no triangle.
pub(crate) const NONE: u32 = u32::MAX;

/// A half-line from where something is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: Vec3,
    /// Of length 1.
    pub(crate) direction: Vec3,
    /// The shape that it leaves.
    shape: u32,
    triangle: u32,
}

impl Ray {
    /// From nowhere in particular.
    #[inline(always)]
    pub(crate) const fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, shape: NONE, triangle: NONE }
    }

    #[inline(always)]
    pub(crate) fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}

/// What a ray meets first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    /// Infinite if it meets nothing.
    pub(crate) t: f32,
    /// Its number, in the order of the arrays.
    pub(crate) shape: u32,
    triangle: u32,
}

/// A point of a surface or in space, from which rays start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) position: Vec3,
    /// The surface's normal, on the side that emits.
    pub(crate) normal: Vec3,
    /// The normal that scatters light: interpolated on meshes with normals.
    pub(crate) shading: Vec3,
    shape: u32,
    triangle: u32,
}

impl Point {
    /// A point in space.
    #[inline(always)]
    pub(crate) const fn free(position: Vec3) -> Self {
        Self { position, normal: Vec3::ZERO, shading: Vec3::ZERO, shape: NONE, triangle: NONE }
    }

    #[inline(always)]
    pub(crate) const fn towards(&self, direction: Vec3) -> Ray {
        Ray { origin: self.position, direction, shape: self.shape, triangle: self.triangle }
    }
}

/// Where a ray is inside a convex shape; empty unless `.0 < .1`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval(pub(crate) f32, pub(crate) f32);

impl Interval {
    const EMPTY: Self = Self(f32::INFINITY, f32::NEG_INFINITY);

    /// Where the ray meets the surface first; infinity if it does not.
    #[inline(always)]
    fn first(self) -> f32 {
        let Self(near, far) = self;
        let t = if near > 0.0 { near } else { far };
        if near <= far && t > 0.0 { t } else { f32::INFINITY }
    }

    /// Its length, 0 if it is empty.
    #[inline(always)]
    pub(crate) fn length(self) -> f32 {
        (self.1 - self.0).max(0.0)
    }

    /// [`first`](Self::first) from a point of the surface itself: one end is 0 but for rounding.
    #[inline(always)]
    fn across(self) -> f32 {
        let t = self.0 + self.1;
        if t > 0.0 { t } else { f32::INFINITY }
    }
}

/// All surfaces. In each array those that the camera sees come first.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    spheres: Vec<Sphere>,
    rectangles: Vec<Rectangle>,
    cubes: Vec<Cube>,
    sphere_packs: Vec<Spheres>,
    rectangle_packs: Vec<Rectangles>,
    pub(crate) meshes: Option<Meshes>,
    /// How many spheres, rectangles and cubes the camera sees.
    seen: [usize; 3],
}

/// A shape that was put into a geometry.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Solid {
    Sphere(Sphere),
    Rectangle(Rectangle),
    Cube(Cube),
    /// The number of the mesh in the description.
    Mesh,
}

impl Geometry {
    /// Sorts the shapes: number k of the geometry is `order[k]` of the description. Those of material `Null` are
    /// no surfaces.
    pub(crate) fn new(shapes: &[description::Shape]) -> Result<(Self, Vec<(usize, Solid)>), SceneError> {
        use description::{Geometry as Described, Material};
        let mut geometry = Self::default();
        let mut sorted: [Vec<(usize, Solid)>; 4] = Default::default();
        for seen in [true, false] {
            for (i, shape) in shapes.iter().enumerate() {
                if shape.surface.material == Material::Null || shape.visible_to_camera != seen {
                    continue;
                }
                let wrong = || SceneError::Shape(i);
                let flip = shape.flip_normals;
                let (kind, solid) = match &shape.geometry {
                    Described::Sphere { center, radius } => {
                        (0, Solid::Sphere(Sphere::new(*center, *radius, flip).ok_or_else(wrong)?))
                    }
                    Described::Rectangle(to_world) => {
                        (1, Solid::Rectangle(Rectangle::new(to_world, flip).ok_or_else(wrong)?))
                    }
                    Described::Cube(to_world) => (2, Solid::Cube(Cube::new(to_world, flip).ok_or_else(wrong)?)),
                    Described::Mesh(_) => (3, Solid::Mesh),
                };
                sorted[kind].push((i, solid));
            }
            for (seen_of_kind, sorted) in geometry.seen.iter_mut().zip(&sorted) {
                if seen {
                    *seen_of_kind = sorted.len();
                }
            }
        }
        let order: Vec<_> = sorted.into_iter().flatten().collect();
        let mut triangles = Vec::new();
        for (number, (i, solid)) in order.iter().enumerate() {
            match solid {
                Solid::Sphere(sphere) => geometry.spheres.push(*sphere),
                Solid::Rectangle(rectangle) => geometry.rectangles.push(*rectangle),
                Solid::Cube(cube) => geometry.cubes.push(*cube),
                Solid::Mesh => mesh::triangles_of(&shapes[*i], *i, number as u32, &mut triangles)?,
            }
        }
        geometry.sphere_packs = packs_of(&geometry.spheres);
        geometry.rectangle_packs = packs_of(&geometry.rectangles);
        if !triangles.is_empty() {
            geometry.meshes = Some(Meshes::new(triangles));
        }
        Ok((geometry, order))
    }

    /// What `ray` meets first.
    #[inline(always)]
    pub(crate) fn closest(&self, ray: &Ray) -> Hit {
        let mut hit = Hit { t: f32::INFINITY, shape: NONE, triangle: NONE };
        closest_in(&self.sphere_packs, ray, 0, &mut hit);
        let mut number = self.spheres.len() as u32;
        closest_in(&self.rectangle_packs, ray, number, &mut hit);
        number += self.rectangles.len() as u32;
        for cube in &self.cubes {
            let t = cube.distance(ray, ray.shape == number);
            if t < hit.t {
                hit = Hit { t, shape: number, triangle: NONE };
            }
            number += 1;
        }
        self.or_triangle::<false>(ray, hit)
    }

    /// What rays of the camera meet first, among what it is to see; but for triangles.
    #[inline(always)]
    pub(crate) fn seen_by_camera(&self, beam: &Beam) -> Nearest {
        let [spheres, rectangles, cubes] = self.seen;
        let mut nearest = Nearest::NOTHING;
        let mut number = 0;
        for sphere in &self.spheres[..spheres] {
            nearest.keep(&sphere.distances(beam), number);
            number += 1;
        }
        number = self.spheres.len() as u32;
        for rectangle in &self.rectangles[..rectangles] {
            let Rectangle { center, normal, duals, .. } = *rectangle;
            let t = beam.distances(|direction| rectangle::distance(center - beam.origin, normal, duals, direction));
            nearest.keep(&t, number);
            number += 1;
        }
        number = (self.spheres.len() + self.rectangles.len()) as u32;
        for cube in &self.cubes[..cubes] {
            nearest.keep(&cube.distances(beam), number);
            number += 1;
        }
        nearest
    }

    /// What ray `lane` of a beam meets first: `nearest`, or a triangle.
    #[inline(always)]
    pub(crate) fn seen_by(&self, ray: &Ray, nearest: &Nearest, lane: usize) -> Hit {
        self.or_triangle::<true>(ray, nearest.lane(lane))
    }

    /// `hit`, or a triangle that is nearer.
    #[inline(always)]
    fn or_triangle<const CAMERA: bool>(&self, ray: &Ray, hit: Hit) -> Hit {
        if let Some(meshes) = &self.meshes
            && let Some((t, triangle)) = meshes.closest::<CAMERA>(*ray, ray.triangle, hit.t)
        {
            return Hit { t, shape: meshes.triangle(triangle).shape, triangle };
        }
        hit
    }

    /// Whether `ray` meets anything before `t`, shape `but` aside: a convex light does not hide a point of its
    /// own that it was sampled at.
    #[inline(always)]
    pub(crate) fn occluded(&self, ray: &Ray, t: f32, but: u32) -> bool {
        let mut number = self.spheres.len() as u32;
        let mut occluded =
            occluded_by(&self.sphere_packs, ray, 0, t, but) | occluded_by(&self.rectangle_packs, ray, number, t, but);
        number += self.rectangles.len() as u32;
        for cube in &self.cubes {
            occluded |= number != but && cube.distance(ray, ray.shape == number) < t;
            number += 1;
        }
        occluded || self.meshes.as_ref().is_some_and(|meshes| meshes.occluded(*ray, ray.triangle, t))
    }

    /// The point where `ray` met `hit`, which is a shape.
    #[inline(always)]
    pub(crate) fn point(&self, ray: &Ray, hit: Hit) -> Point {
        let mut number = hit.shape as usize;
        let position = ray.at(hit.t);
        let point =
            |position, normal: Vec3| Point { position, normal, shading: normal, shape: hit.shape, triangle: NONE };
        if let Some(sphere) = self.spheres.get(number) {
            let (position, normal) = sphere.point(position);
            return point(position, normal);
        }
        number -= self.spheres.len();
        if let Some(rectangle) = self.rectangles.get(number) {
            return point(position, rectangle.normal);
        }
        number -= self.rectangles.len();
        if let Some(cube) = self.cubes.get(number) {
            return point(position, cube.normal(position));
        }
        match &self.meshes {
            Some(meshes) => {
                let (normal, shading) = meshes.triangle(hit.triangle).normals(position);
                Point { position, normal, shading, shape: hit.shape, triangle: hit.triangle }
            }
            None => Point::free(position),
        }
    }
}
