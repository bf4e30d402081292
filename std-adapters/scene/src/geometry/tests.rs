//! Against double precision, and side by side against alone.

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
