//! What can be wrong with a scene.

use core::fmt;

/// Why a [`Description`](crate::Description) cannot be rendered. Shapes and lights are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SceneError {
    /// The camera's transform is singular or not finite.
    Camera,
    /// The angle of view is not between 0 and 180 degrees.
    FieldOfView,
    /// The image has no pixels.
    Size,
    /// A tent's radius is not positive.
    Filter,
    /// `max_depth` is 0: not even light that is seen directly.
    Depth,
    /// Neither a shape nor anything else emits light.
    NoLight,
    /// A shape has no area, or a number that is not finite.
    Shape(usize),
    /// A mesh has a triangle with a corner that is not there, or normals for some of its corners only.
    Mesh(usize),
    /// A radiance, reflectance, roughness or coefficient is negative, not finite or, if a part, above 1.
    Value(usize),
    /// A medium in something that is not a sphere or a cube with the material [`Null`](crate::Material::Null).
    Medium(usize),
    /// A shape of material [`Null`](crate::Material::Null) that emits light.
    NullLight(usize),
    /// A light that is not a surface has a number that is negative or not finite.
    Light(usize),
    /// The channels differ, and were to be rendered as one.
    Channels,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Camera => f.write_str("camera: to_world is singular or not finite; give a lookat or another matrix"),
            Self::FieldOfView => f.write_str("camera: fov must be between 0 and 180 degrees"),
            Self::Size => f.write_str("film: width and height must be at least 1"),
            Self::Filter => f.write_str("film: the radius of the tent must be positive"),
            Self::Depth => f.write_str("max_depth must be at least 1"),
            Self::NoLight => f.write_str("no light: give a shape an emission, or the scene a light"),
            Self::Shape(i) => write!(f, "shape {i}: no area, or not finite; give it another transform or radius"),
            Self::Mesh(i) => write!(f, "shape {i}: a triangle's corner is out of range, or corners lack normals"),
            Self::Value(i) => write!(
                f,
                "shape {i}: radiance, extinction and roughness must be finite and not negative, reflectance and \
                 albedo in [0, 1]"
            ),
            Self::Medium(i) => {
                write!(f, "shape {i}: a medium must be in a sphere or a cube of material Null (index-matched)")
            }
            Self::NullLight(i) => write!(f, "shape {i}: material Null cannot emit; make it black and diffuse"),
            Self::Light(i) => write!(f, "light {i}: its numbers must be finite and not negative"),
            Self::Channels => f.write_str("the channels differ: render in Spectrum<f32, 3>, not in f32"),
        }
    }
}

impl core::error::Error for SceneError {}
