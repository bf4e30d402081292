//! Scene files: a subset of [Mitsuba 3](https://mitsuba.readthedocs.io)'s XML, read as Mitsuba 3.9.1 reads it.
//!
//! | element | what is read |
//! |---|---|
//! | `scene` | versions 2 and 3 |
//! | `default` | `$name` in any attribute after it; the first of a name holds |
//! | `ref` | to any bsdf, medium, emitter, shape, …, before or after it |
//! | `integrator` | `path`, `volpath`, `volpathmis`: `max_depth`, `rr_depth` |
//! | `sensor` | one `perspective`: `to_world`, `fov` (required), `fov_axis` |
//! | `film` | `hdrfilm`: `width`, `height`, and an `rfilter`: `box`, `tent` (`radius`) |
//! | `sampler` | of any type: `sample_count` |
//! | `shape` | `sphere` (`center`, `radius`), `rectangle`, `cube`, `obj`, `ply` (`filename`, `face_normals`): `to_world`, `flip_normals`, `visible_to_camera`, a bsdf, an emitter, a medium |
//! | `bsdf` | `diffuse` (`reflectance`), `roughconductor` (`distribution` "ggx", `material` "none", `alpha`, `specular_reflectance`), `blendbsdf` of three conductors, `twosided`, `null` |
//! | `emitter` | `area` (`radiance`) in a shape; `constant` (`radiance`), `point` (`position` or `to_world`, `intensity`) |
//! | `medium` | `homogeneous` named `interior`, in a sphere or cube whose bsdf is `null`: `sigma_t`, `albedo`, `scale`, an `isotropic` phase |
//! | `transform` | `translate`, `scale`, `rotate`, `lookat`, `matrix` (16 or 9 numbers), in their order |
//! | colours | `rgb` of three linear numbers or one; `float`, which is grey; `texture type="srgb"` (`color`) |
//! | `point`, `float`, `integer`, `boolean`, `string` | as parameters of the above |
//!
//! Anything else is an error that names the place and what is known there; a [lenient](Leniency::Lenient)
//! reading leaves it out and says so in a [`Warning`]. Wrong values are errors in either.
//!
//! What differs from Mitsuba:
//! - No Russian roulette unless `rr_depth` is given (Mitsuba: from depth 5).
//! - Without an `rfilter`, a box, and a warning (Mitsuba: a Gaussian).
//! - `<boolean name="visible_to_camera" value="false"/>` lets rays of the camera pass through a shape. Mitsuba has
//!   no such thing.
//! - A roughness per channel is nested `blendbsdf`s of three `roughconductor`s in equal parts, the
//!   `specular_reflectance` of each three times that of one channel and 0 in the others. It is read as one
//!   [`Conductor`](crate::Material::Conductor), and is the same surface.
//! - `sigma_t` may exceed 1 without `scale`, and a colour of these conductors 1 without `texture`.
//! - Triangles without area are left out, and null shapes without a medium.
//! - The axis of `rotate` must have length 1; rotations by quarter turns are exact.

mod built_in;
mod element;
mod emitter;
mod error;
mod file;
mod integrator;
mod medium;
mod mesh;
mod obj;
mod ply;
mod scene;
mod sensor;
mod shape;
mod surface;
mod transform;

pub use built_in::BuiltIn;
pub use error::{Error, Warning};

use crate::Description;
use std::path::Path;

/// What to do with what is not supported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Leniency {
    /// It is an error.
    #[default]
    Strict,
    /// It is left out, with a warning; a bsdf becomes grey of reflectance 0.5.
    Lenient,
}

impl Description {
    /// Reads a scene file, and the meshes that it names beside it.
    ///
    /// # Errors
    /// What is wrong, and where: [`Error`].
    ///
    /// ```
    /// use ratiocv_scene::{Description, Leniency};
    /// let error = Description::read("missing.xml".as_ref(), Leniency::Strict).unwrap_err();
    /// assert!(error.to_string().starts_with("missing.xml: cannot be read"));
    /// ```
    pub fn read(path: &Path, leniency: Leniency) -> Result<(Self, Vec<Warning>), Error> {
        let name = path.to_string_lossy();
        let bytes = std::fs::read(path).map_err(|e| Error::of_file(&name, format_args!("cannot be read: {e}")))?;
        let text = core::str::from_utf8(&bytes).map_err(|error| {
            let line = 1 + bytes[..error.valid_up_to()].iter().filter(|byte| **byte == b'\n').count();
            Error::of_file(&name, format_args!("line {line} is not UTF-8; save the file as UTF-8"))
        })?;
        Self::parse(text, &name, leniency)
    }

    /// Reads a scene from text. `name` is its file for messages; meshes are looked for in its folder.
    ///
    /// # Errors
    /// What is wrong, and where: [`Error`].
    ///
    /// ```
    /// use ratiocv_scene::{Description, Leniency, Light};
    /// let text = r#"<scene version="3.0.0">
    ///     <sensor type="perspective">
    ///         <float name="fov" value="40"/>
    ///         <film type="hdrfilm"><rfilter type="box"/></film>
    ///     </sensor>
    ///     <emitter type="constant"><rgb name="radiance" value="1, 0.5, 2"/></emitter>
    ///     <shape type="cylinder"/>
    /// </scene>"#;
    /// let (scene, warnings) = Description::parse(text, "scene.xml", Leniency::Lenient)?;
    /// assert_eq!(scene.lights, [Light::Environment([1.0, 0.5, 2.0].into())]);
    /// assert_eq!(warnings[0].error().line(), Some(7)); // the cylinder, which was left out
    /// assert!(Description::parse(text, "scene.xml", Leniency::Strict).is_err());
    /// # Ok::<(), ratiocv_scene::Error>(())
    /// ```
    pub fn parse(text: &str, name: &str, leniency: Leniency) -> Result<(Self, Vec<Warning>), Error> {
        let tree = file::tree(text, name)?;
        let file = file::File::new(&tree, name, leniency)?;
        let description = scene::read(&file)?;
        Ok((description, file.take_warnings()))
    }
}
