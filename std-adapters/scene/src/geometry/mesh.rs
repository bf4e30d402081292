//! Triangles in a hierarchy of boxes; a scene without any has none of this.

use crate::description::{self, Shape};
use crate::error::SceneError;
use crate::geometry::Ray;
use crate::planted::planted;
use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::bvh2::{Bvh2, builder::build_bvh2_from_tris};
use obvhs::ray::{Ray as BoxRay, RayHit};

/// A triangle of a mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    corner: Vec3,
    edges: [Vec3; 2],
    /// The normal that emits.
    normal: Vec3,
    /// Normals of the corners, the flat one without.
    normals: [Vec3; 3],
    /// The shape that it belongs to.
    pub(crate) shape: u32,
    /// Seen by the camera.
    seen: bool,
}

impl Triangle {
    /// The distance, infinite if the ray passes (Möller and Trumbore 1997). Edges belong to both sides, to
    /// rounding.
    #[inline(always)]
    fn distance(&self, ray: &Ray) -> f32 {
        let [a, b] = self.edges;
        let p = ray.direction.cross(b);
        let scale = 1.0 / a.dot(p);
        let from_corner = ray.origin - self.corner;
        let q = from_corner.cross(a);
        let (u, v) = (from_corner.dot(p) * scale, ray.direction.dot(q) * scale);
        let met = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0);
        if met { b.dot(q) * scale } else { f32::INFINITY }
    }

    /// The normal that emits, and the interpolated one.
    pub(crate) fn normals(&self, position: Vec3) -> (Vec3, Vec3) {
        let [a, b] = self.edges;
        let (p, area) = (position - self.corner, a.cross(b));
        let scale = 1.0 / area.dot(area);
        let (u, v) = (p.cross(b).dot(area) * scale, a.cross(p).dot(area) * scale);
        let [n, n_u, n_v] = self.normals;
        let shading = planted!("normal_of_one_corner": n * (1.0 - u - v) + n_u * u + n_v * v, n);
        (self.normal, shading.normalize_or(self.normal))
    }

    pub(crate) fn area(&self) -> f32 {
        0.5 * self.edges[0].cross(self.edges[1]).length()
    }

    /// A point that is uniform over the area, and the normal that emits.
    pub(crate) fn sample(&self, [u, v]: [f32; 2]) -> (Vec3, Vec3) {
        let root = planted!("triangle_by_a_corner": u.sqrt(), u);
        (self.corner + self.edges[0] * (root * (1.0 - v)) + self.edges[1] * (root * v), self.normal)
    }

    pub(crate) fn corners(&self) -> [Vec3; 3] {
        [self.corner, self.corner + self.edges[0], self.corner + self.edges[1]]
    }
}

/// Puts the triangles of shape `i` of the description, number `number` of the geometry, behind the others.
/// Those without an area are left out.
pub(super) fn triangles_of(shape: &Shape, i: usize, number: u32, all: &mut Vec<Triangle>) -> Result<(), SceneError> {
    let description::Geometry::Mesh(mesh) = &shape.geometry else { return Ok(()) };
    let (before, flip) = (all.len(), if shape.flip_normals { -1.0 } else { 1.0 });
    if !mesh.normals.is_empty() && mesh.normals.len() != mesh.positions.len() {
        return Err(SceneError::Mesh(i));
    }
    for corners in &mesh.triangles {
        let corners = corners.map(|corner| corner as usize);
        if corners.iter().any(|corner| *corner >= mesh.positions.len()) {
            return Err(SceneError::Mesh(i));
        }
        let [a, b, c] = corners.map(|corner| mesh.positions[corner]);
        let edges = [b - a, c - a];
        let normal = edges[0].cross(edges[1]).normalize_or_zero() * flip;
        if ![a, b, c].iter().all(|corner| corner.is_finite()) {
            return Err(SceneError::Shape(i));
        }
        if normal == Vec3::ZERO {
            continue;
        }
        let normals = corners.map(|corner| mesh.normals.get(corner).map_or(normal, |n| *n * flip));
        let seen = shape.visible_to_camera;
        all.push(Triangle { corner: a, edges, normal, normals, shape: number, seen });
    }
    if all.len() == before { Err(SceneError::Shape(i)) } else { Ok(()) }
}

/// All triangles of a scene.
pub(crate) struct Meshes {
    /// In the order of the hierarchy's leaves.
    triangles: Vec<Triangle>,
    hierarchy: Bvh2,
}

impl core::fmt::Debug for Meshes {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} triangles", self.triangles.len())
    }
}

impl Meshes {
    pub(super) fn new(triangles: Vec<Triangle>) -> Self {
        let corners: Vec<_> = triangles
            .iter()
            .map(|triangle| {
                let [v0, v1, v2] = triangle.corners().map(Into::into);
                obvhs::triangle::Triangle { v0, v1, v2 }
            })
            .collect();
        // Without splits, each triangle is in one leaf.
        let parameters = BvhBuildParams { pre_split: false, ..BvhBuildParams::medium_build() };
        let hierarchy = build_bvh2_from_tris(&corners, parameters, &mut Default::default());
        let triangles = hierarchy.primitive_indices.iter().map(|i| triangles[*i as usize]).collect();
        Self { triangles, hierarchy }
    }

    pub(crate) fn triangle(&self, triangle: u32) -> &Triangle {
        &self.triangles[triangle as usize]
    }

    pub(crate) fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The least distance from one triangle to another one that a ray may meet: some roundings of its origin.
    fn least(ray: &Ray, from: u32) -> f32 {
        if from == super::NONE { 0.0 } else { 16.0 * f32::EPSILON * ray.origin.abs().max_element() }
    }

    /// The nearest triangle before `t`, and its distance.
    // The ray by value: one whose address is taken lives in memory, in all kernels and scenes without meshes too.
    #[inline(never)]
    pub(super) fn closest<const CAMERA: bool>(&self, ray: Ray, from: u32, t: f32) -> Option<(f32, u32)> {
        let least = Self::least(&ray, from);
        let mut hit = RayHit::none();
        let boxes = BoxRay::new(ray.origin.into(), ray.direction.into(), 0.0, t);
        self.hierarchy.ray_traverse(boxes, &mut hit, |_, i| {
            let triangle = &self.triangles[i];
            let distance = triangle.distance(&ray);
            let met = distance > least && i as u32 != from && (!CAMERA || triangle.seen);
            if met { distance } else { f32::INFINITY }
        });
        (hit.t < t).then_some((hit.t, hit.primitive_id))
    }

    /// Whether anything is met before `t`.
    #[inline(never)]
    pub(super) fn occluded(&self, ray: Ray, from: u32, t: f32) -> bool {
        let least = Self::least(&ray, from);
        let boxes = BoxRay::new(ray.origin.into(), ray.direction.into(), 0.0, t);
        !self.hierarchy.ray_traverse_miss(boxes, |_, i| {
            let distance = self.triangles[i].distance(&ray);
            if distance > least && i as u32 != from { distance } else { f32::INFINITY }
        })
    }
}
