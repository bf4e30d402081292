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
            let (to_origin, square) = (beam.origin - sphere.center, sphere.radius * sphere.radius);
            let t = beam.distances(|direction| sphere::distance(to_origin, square, direction));
            nearest.keep(&t, number);
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
            let t = beam.distances(|direction| cube.distance(&Ray::new(beam.origin, direction), false));
            nearest.keep(&t, number);
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
            && let Some((t, triangle)) = meshes.closest::<CAMERA>(ray, ray.triangle, hit.t)
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
        occluded || self.meshes.as_ref().is_some_and(|meshes| meshes.occluded(ray, ray.triangle, t))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::description::{Geometry as Described, Material, Mesh, Shape, Surface};
    use crate::frame::uniform_direction;
    use crate::lanes::LANES;
    use crate::random::Random;
    use glam::{Affine3A, DVec3, Mat3, Quat};

    fn shape(geometry: Described) -> Shape {
        let surface = Surface { material: Material::Diffuse { reflectance: Vec3::ONE }, two_sided: true };
        Shape { geometry, surface, emission: None, medium: None, flip_normals: false, visible_to_camera: true }
    }

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from_array([random.uniform(), random.uniform(), random.uniform()]) * 2.0 - 1.0
    }

    /// Sheared, rotated, moved.
    fn transform(random: &mut Random, size: f32) -> Affine3A {
        let rotation = Mat3::from_quat(Quat::from_rotation_arc(Vec3::Z, uniform_direction(random.uniforms())));
        let shear = Mat3::from_cols(Vec3::X, Vec3::new(0.4 * random.uniform(), 1.0, 0.0), Vec3::new(0.1, 0.2, 1.0));
        Affine3A::from_mat3_translation(rotation * shear * size, vector(random) * 3.0)
    }

    /// All distances at which the line meets the shape, in `f64`, with how clearly it does.
    fn distances(shape: &Shape, origin: DVec3, direction: DVec3) -> Vec<(f64, f64)> {
        let d = |v: Vec3| v.as_dvec3();
        match &shape.geometry {
            Described::Sphere { center, radius } => {
                let (o, r) = (origin - d(*center), f64::from(*radius));
                let (b, c) = (o.dot(direction), o.dot(o) - r * r);
                let square = b * b - c;
                if square < 0.0 {
                    return Vec::new();
                }
                let half = libm::sqrt(square);
                vec![(-b - half, half), (-b + half, half)]
            }
            Described::Rectangle(to_world) | Described::Cube(to_world) => {
                let matrix = glam::Mat4::from(*to_world).as_dmat4().inverse();
                let (o, v) = (matrix.transform_point3(origin), matrix.transform_vector3(direction));
                let planes: &[(usize, f64)] = if matches!(shape.geometry, Described::Rectangle(_)) {
                    &[(2, 0.0)]
                } else {
                    &[(0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0), (2, -1.0), (2, 1.0)]
                };
                let met = planes.iter().filter_map(|(axis, place)| {
                    let t = (place - o[*axis]) / v[*axis];
                    let p = o + v * t;
                    let others = [(axis + 1) % 3, (axis + 2) % 3];
                    let inside = others.iter().map(|k| 1.0 - p[*k].abs()).fold(f64::INFINITY, f64::min);
                    (inside >= 0.0).then_some((t, inside * v[*axis].abs()))
                });
                met.collect()
            }
            Described::Mesh(mesh) => {
                let met = mesh.triangles.iter().filter_map(|corners| {
                    let [a, b, c] = corners.map(|i| d(mesh.positions[i as usize]));
                    let (ab, ac) = (b - a, c - a);
                    let p = direction.cross(ac);
                    let scale = 1.0 / ab.dot(p);
                    let s = origin - a;
                    let q = s.cross(ab);
                    let (u, v) = (s.dot(p) * scale, direction.dot(q) * scale);
                    let inside = u.min(v).min(1.0 - u - v);
                    (inside >= 0.0).then_some((ac.dot(q) * scale, inside))
                });
                met.collect()
            }
        }
    }

    fn many(random: &mut Random) -> Vec<Shape> {
        let mut shapes = Vec::new();
        for _ in 0..11 {
            let center = vector(random) * 3.0;
            shapes.push(shape(Described::Sphere { center, radius: 0.1 + random.uniform() * 0.5 }));
            shapes.push(shape(Described::Rectangle(transform(random, 0.5))));
            shapes.push(shape(Described::Cube(transform(random, 0.3))));
            let positions = (0..9).map(|_| vector(random) * 3.0).collect();
            let triangles = vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]];
            shapes.push(shape(Described::Mesh(Mesh { positions, normals: Vec::new(), triangles })));
        }
        shapes
    }

    #[test]
    fn rays_meet_what_double_precision_says() {
        let mut random = Random::new(1, [0, 0], 0);
        let shapes = many(&mut random);
        let (geometry, order) = Geometry::new(&shapes).expect("sound shapes");
        let mut met = 0;
        for _ in 0..20_000 {
            let ray = Ray::new(vector(&mut random) * 4.0, uniform_direction(random.uniforms()));
            let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3().normalize());
            let mut right = (f64::INFINITY, 1.0, NONE);
            let mut clear = true;
            for (number, (i, _)) in order.iter().enumerate() {
                for (t, clearness) in distances(&shapes[*i], origin, direction) {
                    clear &= clearness > 1e-3 && t.abs() > 1e-4;
                    if t > 0.0 && t < right.0 {
                        right = (t, clearness, number as u32);
                    }
                }
            }
            if !clear {
                continue;
            }
            let hit = geometry.closest(&ray);
            assert_eq!(hit.shape, right.2, "{ray:?}");
            let end = if right.2 == NONE { 100.0 } else { hit.t };
            assert!(!geometry.occluded(&ray, end * 0.999, NONE));
            if hit.shape != NONE {
                met += 1;
                assert!((f64::from(hit.t) - right.0).abs() <= 2e-5 * (1.0 + right.0), "{hit:?} {right:?}");
                assert!(geometry.occluded(&ray, end * 1.001, NONE));
                let point = geometry.point(&ray, hit);
                let there = origin + direction * right.0;
                assert!((point.position.as_dvec3() - there).length() <= 2e-5);
                assert!((point.normal.length() - 1.0).abs() <= 1e-5);
            }
        }
        assert!(met > 5000, "{met}");
    }

    /// From each point of a closed convex shape, a ray outwards does not meet it, and one inwards does, at the
    /// other side.
    #[test]
    fn a_convex_shape_is_left_and_crossed_without_offsets() {
        let mut random = Random::new(2, [0, 0], 0);
        let far = 1000.0 * Vec3::ONE;
        let shapes = [
            shape(Described::Sphere { center: far, radius: 0.5 }),
            shape(Described::Cube(Affine3A::from_translation(far))),
        ];
        for shape in shapes {
            let (geometry, _) = Geometry::new(&[shape]).expect("a sound shape");
            for _ in 0..10_000 {
                let ray = Ray::new(far + uniform_direction(random.uniforms()) * 3.0, Vec3::X);
                let ray = Ray::new(ray.origin, (far + vector(&mut random) * 0.4 - ray.origin).normalize());
                let hit = geometry.closest(&ray);
                let point = geometry.point(&ray, hit);
                let out = uniform_direction(random.uniforms());
                let out = if out.dot(point.normal) > 0.0 { out } else { -out };
                if out.dot(point.normal) < 0.02 {
                    continue;
                }
                let away = geometry.closest(&point.towards(out));
                assert!(away.shape != hit.shape, "{point:?} {out}");
                assert_eq!(geometry.closest(&point.towards(-out)).shape, hit.shape, "{point:?} {out}");
            }
        }
    }

    /// Numbers of one kind go on where those of another end: in its empty lanes.
    #[test]
    fn a_ray_from_a_rectangle_is_none_of_an_empty_sphere() {
        let floor = Described::Rectangle(Affine3A::from_translation(Vec3::Z * -2.0));
        let shapes = [shape(Described::Sphere { center: Vec3::X * 9.0, radius: 1.0 }), shape(floor)];
        let (geometry, _) = Geometry::new(&shapes).expect("sound shapes");
        let down = Ray::new(Vec3::ZERO, -Vec3::Z);
        let hit = geometry.closest(&down);
        let up = geometry.point(&down, hit).towards(Vec3::Z);
        assert_eq!((hit.shape, geometry.closest(&up).shape), (1, NONE));
        assert!(!geometry.occluded(&up, 10.0, NONE));
    }

    /// Also from shapes, and to points of shapes that do not hide them.
    #[test]
    fn segments_side_by_side_are_hidden_as_each_is_alone() {
        let mut random = Random::new(8, [0, 0], 0);
        let (geometry, order) = Geometry::new(&many(&mut random)).expect("sound shapes");
        let mut counts = [0; 2];
        for _ in 0..2000 {
            let (mut segments, mut alone) = (Segments::NONE, [false; LANES]);
            // The last lanes stay empty.
            for (lane, alone) in alone.iter_mut().enumerate().take(LANES - 2) {
                let mut ray = Ray::new(vector(&mut random) * 4.0, uniform_direction(random.uniforms()));
                let hit = geometry.closest(&ray);
                if hit.shape != NONE && random.uniform() < 0.5 {
                    ray = geometry.point(&ray, hit).towards(uniform_direction(random.uniforms()));
                }
                let to = if random.uniform() < 0.5 { NONE } else { random.below(order.len()) as u32 };
                let end = 3.0 * random.uniform();
                segments.set(lane, &ray, end, to);
                *alone = geometry.occluded(&ray, end, to);
                counts[usize::from(*alone)] += 1;
            }
            assert_eq!(geometry.hidden(&segments), alone);
        }
        assert!(counts.iter().all(|count| *count > 1000), "{counts:?}");
    }

    /// To the bit.
    #[test]
    fn rays_side_by_side_meet_what_each_meets_alone() {
        let mut random = Random::new(7, [0, 0], 0);
        let (geometry, _) = Geometry::new(&many(&mut random)).expect("sound shapes");
        let mut met = 0;
        for _ in 0..1000 {
            let directions: [Vec3; Beam::RAYS] = core::array::from_fn(|_| vector(&mut random));
            let beam = Beam::new(vector(&mut random) * 4.0, |lane| directions[lane]);
            let seen = geometry.seen_by_camera(&beam);
            for lane in 0..Beam::RAYS {
                let ray = beam.ray(lane);
                let (ours, right) = (geometry.seen_by(&ray, &seen, lane), geometry.closest(&ray));
                assert_eq!((ours.t, ours.shape, ours.triangle), (right.t, right.shape, right.triangle));
                met += usize::from(right.shape != NONE);
            }
        }
        assert!(met > 1000, "{met}");
    }

    #[test]
    fn shapes_that_the_camera_does_not_see_still_hide() {
        let mut shapes: Vec<_> =
            (0..12).map(|i| shape(Described::Sphere { center: Vec3::Z * (2.0 * i as f32), radius: 0.5 })).collect();
        shapes.iter_mut().step_by(2).for_each(|shape| shape.visible_to_camera = false);
        let (geometry, order) = Geometry::new(&shapes).expect("sound shapes");
        let ray = Ray::new(-5.0 * Vec3::Z, Vec3::Z);
        let seen = geometry.seen_by_camera(&Beam::new(ray.origin, |_| ray.direction));
        assert_eq!(order[seen.lane(3).shape as usize].0, 1);
        assert_eq!(order[geometry.closest(&ray).shape as usize].0, 0);
        assert!(geometry.occluded(&ray, 5.0, NONE));
        // The light itself is passed over, what is before it is not.
        let light = geometry.closest(&ray).shape;
        assert!(!geometry.occluded(&ray, 5.0, light) && geometry.occluded(&ray, 7.0, light));
    }
}
