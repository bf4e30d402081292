//! A scene as a file says it: plain data, checked, but not yet prepared for rendering.

use glam::{Affine3A, Vec3};

/// A scene: what a scene file says, with defaults filled in. Radiances, reflectances and coefficients are
/// linear RGB.
#[derive(Clone, Debug)]
pub struct Description {
    /// Longest path, as Mitsuba counts: 1 is emission seen directly, 2 adds one scattering event; `None`: no
    /// limit.
    pub max_depth: Option<u32>,
    /// From this depth on, paths end by Russian roulette; `None`: never.
    pub roulette_depth: Option<u32>,
    /// The point of view.
    pub camera: Camera,
    /// Columns and rows of the image.
    pub size: [u32; 2],
    /// Where in and about a pixel its rays pass.
    pub filter: Filter,
    /// Samples per pixel.
    pub samples: u32,
    /// Everything that a ray can meet.
    pub shapes: Vec<Shape>,
    /// Lights that are not surfaces.
    pub lights: Vec<Light>,
}

/// A pinhole.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// From camera space, where it looks along +z with +y up and +x to the *left* of the image, to the world.
    pub to_world: Affine3A,
    /// The angle of view between the left and the right edge of the image, in degrees.
    pub fov: f32,
}

/// The reconstruction filter, sampled in proportion to itself, so that samples have no weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filter {
    /// Uniform over the pixel.
    Box,
    /// Falls linearly to 0 at `radius` pixels from the centre, along each axis.
    Tent {
        /// In pixels.
        radius: f32,
    },
}

/// A surface with what it is made of and what it holds.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Where it is.
    pub geometry: Geometry,
    /// How it scatters light.
    pub surface: Surface,
    /// Radiance that it emits, on the side of its normal.
    pub emission: Option<Vec3>,
    /// What it is filled with, if it is a sphere or a cube.
    pub medium: Option<Medium>,
    /// Normals point inwards.
    pub flip_normals: bool,
    /// `false`: rays from the camera pass through.
    pub visible_to_camera: bool,
}

/// Where a shape is.
#[derive(Clone, Debug)]
pub enum Geometry {
    /// A sphere.
    Sphere {
        /// Its centre.
        center: Vec3,
        /// Its radius.
        radius: f32,
    },
    /// The square \[−1, 1\]² of the plane z = 0, with the normal +z, transformed.
    Rectangle(Affine3A),
    /// The cube \[−1, 1\]³, transformed.
    Cube(Affine3A),
    /// Triangles, in the world.
    Mesh(Mesh),
}

/// Triangles.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Corners.
    pub positions: Vec<Vec3>,
    /// Normals of the corners; empty: each triangle is flat.
    pub normals: Vec<Vec3>,
    /// Corners of each triangle, counterclockwise seen from outside; all in range.
    pub triangles: Vec<[u32; 3]>,
}

/// How a surface scatters light.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// What it is made of.
    pub material: Material,
    /// The same on both sides; otherwise black on the side away from the normal.
    pub two_sided: bool,
}

/// What a surface is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Lambertian: albedo/π.
    Diffuse {
        /// Its albedo.
        reflectance: Vec3,
    },
    /// Isotropic GGX with separable Smith shadowing; the reflectance stands for Fresnel's term.
    Conductor {
        /// α of GGX.
        roughness: Roughness,
        /// The reflectance.
        reflectance: Vec3,
    },
    /// Nothing is there but the bound of a medium: rays pass.
    Null,
}

/// α of GGX, one for all channels or one for each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Roughness {
    /// The same in all channels.
    Grey(f32),
    /// Per channel.
    Chromatic(Vec3),
}

/// A homogeneous medium with an isotropic phase function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Extinction per unit of length.
    pub extinction: Vec3,
    /// The part of it that is scattering.
    pub albedo: Vec3,
}

/// A light that is not a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// The same radiance from everywhere.
    Environment(Vec3),
    /// A point.
    Point {
        /// Where.
        position: Vec3,
        /// Radiant intensity.
        intensity: Vec3,
    },
}
