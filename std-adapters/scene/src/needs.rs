//! What a scene needs, read before it is rendered, so that a kernel without the rest can be chosen.

use crate::description::{Description, Geometry, Light, Material, Roughness, Shape};
use crate::{LightChoice, Mixture};
use core::fmt;
use glam::Vec3;

/// How a scene is to be rendered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// `false`: plain Monte Carlo, in kernels that contain nothing of auxiliaries.
    pub auxiliary: bool,
    /// What each channel would choose lights by.
    pub choice: LightChoice,
    /// What is chosen for all channels.
    pub mixture: Mixture,
}

/// Auxiliaries; lights by what they contribute to a channel, L2 over the channels.
impl Default for Options {
    fn default() -> Self {
        Self { auxiliary: true, choice: LightChoice::default(), mixture: Mixture::default() }
    }
}

/// What a scene needs, and what it does not.
///
/// ```
/// use ratiocv_scene::{Description, Needs};
/// let needs = Needs::of(&Description::built_in("S1")?, &Default::default());
/// println!("{needs}"); // what is left out, and why
/// assert!(needs.coloured_lights && needs.explain().contains(&"media: none"));
/// # Ok::<(), ratiocv_scene::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Needs {
    /// 3, or 1 if red, green and blue are equal in every number of the scene.
    pub channels: usize,
    /// There is something whose sampling depends on the channel, and auxiliaries are wanted.
    pub auxiliary: bool,
    /// Lights of different colours, one of which is chosen.
    pub coloured_lights: bool,
    /// Conductors whose roughness depends on the channel.
    pub coloured_conductors: bool,
    /// Media that scatter and whose extinction depends on the channel.
    pub coloured_media: bool,
    /// Lights that can be sampled: surfaces and points.
    pub lights: usize,
    /// Light from everywhere.
    pub environment: bool,
    /// Conductors at all.
    pub conductors: bool,
    /// Media at all.
    pub media: bool,
    /// Triangles.
    pub meshes: bool,
    /// Lights are sampled.
    pub light_sampling: bool,
    /// Light that scattered rays meet counts.
    pub scattering: bool,
    /// The longest path; `None`: no limit.
    pub depth: Option<u32>,
    wanted: bool,
}

fn is_grey(v: Vec3) -> bool {
    v.x == v.y && v.y == v.z
}

fn numbers(shape: &Shape) -> Vec<Vec3> {
    let mut numbers = vec![shape.emission.unwrap_or(Vec3::ZERO)];
    match shape.surface.material {
        Material::Diffuse { reflectance } => numbers.push(reflectance),
        Material::Conductor { roughness, reflectance } => {
            numbers.push(reflectance);
            if let Roughness::Chromatic(roughness) = roughness {
                numbers.push(roughness);
            }
        }
        Material::Null => {}
    }
    if let Some(medium) = shape.medium {
        numbers.extend([medium.extinction, medium.albedo]);
    }
    numbers
}

/// Whether some colour is not a multiple of another, to rounding.
fn differ(colours: &[Vec3]) -> bool {
    let Some(first) = colours.first() else { return false };
    colours.iter().any(|colour| colour.cross(*first).length() > 1e-5 * colour.length() * first.length())
}

impl Needs {
    /// What `scene` needs.
    pub fn of(scene: &Description, options: &Options) -> Self {
        let surfaces = || scene.shapes.iter().filter(|shape| shape.surface.material != Material::Null);
        let media = || scene.shapes.iter().filter_map(|shape| shape.medium);
        let emissions = || surfaces().filter_map(|shape| shape.emission).filter(|emission| *emission != Vec3::ZERO);
        let points = || {
            scene.lights.iter().filter_map(|light| match light {
                Light::Point { intensity, .. } if *intensity != Vec3::ZERO => Some(*intensity),
                _ => None,
            })
        };
        let environments = || {
            scene.lights.iter().filter_map(|light| match light {
                Light::Environment(radiance) if *radiance != Vec3::ZERO => Some(*radiance),
                _ => None,
            })
        };
        let sampled: Vec<Vec3> = emissions().chain(points()).collect();
        let grey = scene.shapes.iter().flat_map(numbers).chain(points()).chain(environments()).all(is_grey);
        let scattered = scene.max_depth.is_none_or(|depth| depth > 1);
        let conductors = surfaces().any(|shape| matches!(shape.surface.material, Material::Conductor { .. }));
        let coloured_conductors = surfaces().any(|shape| {
            matches!(shape.surface.material, Material::Conductor { roughness: Roughness::Chromatic(a), .. } if !is_grey(a))
        });
        let coloured_media =
            media().any(|medium| !is_grey(medium.extinction) && medium.extinction * medium.albedo != Vec3::ZERO);
        let light_sampling = scattered && !sampled.is_empty();
        let environment = environments().next().is_some();
        let coloured_lights = light_sampling && options.choice != LightChoice::Uniform && differ(&sampled);
        let coloured_conductors = scattered && coloured_conductors;
        let coloured = coloured_lights || coloured_conductors || coloured_media;
        Self {
            channels: if grey { 1 } else { 3 },
            auxiliary: options.auxiliary && coloured && !grey,
            coloured_lights,
            coloured_conductors,
            coloured_media,
            lights: sampled.len(),
            environment,
            conductors,
            media: media().next().is_some(),
            meshes: surfaces().any(|shape| matches!(shape.geometry, Geometry::Mesh(_))),
            light_sampling,
            // A light that diffuse surfaces alone are lit by is better sampled than met by chance.
            scattering: scattered && (environment || (conductors && emissions().next().is_some())),
            depth: scene.max_depth,
            wanted: options.auxiliary,
        }
    }

    /// Light is scattered once, by a diffuse surface, and comes from lights that are sampled: eight paths are traced
    /// side by side.
    pub(crate) fn direct_alone(&self) -> bool {
        self.depth == Some(2) && self.light_sampling && !(self.scattering || self.conductors || self.media)
    }

    /// What is left out, and why: a line each.
    pub fn explain(&self) -> Vec<&'static str> {
        let mut lines = Vec::new();
        let mut say = |left_out: bool, line| {
            if left_out {
                lines.push(line);
            }
        };
        say(self.channels == 1, "three channels: red, green and blue are equal everywhere; one is rendered");
        say(!self.wanted, "auxiliaries: not wanted");
        let coloured = self.coloured_lights || self.coloured_conductors || self.coloured_media;
        say(self.wanted && !coloured, "auxiliaries: every channel would sample alike, so h = 1");
        say(self.auxiliary && !self.coloured_lights, "auxiliary of the choice of lights: nothing to choose by colour");
        say(
            self.auxiliary && !self.coloured_conductors,
            "auxiliary of reflection: no roughness depends on the channel",
        );
        say(self.auxiliary && !self.coloured_media, "auxiliary of media: no scattering medium depends on the channel");
        say(self.lights < 2, "choice of lights: there is one at most");
        say(!self.light_sampling, "sampling of lights: there is none but the environment, or no scattering");
        say(!self.scattering, "emission met by scattered rays, and weights: all of it is sampled directly");
        say(self.scattering && !self.light_sampling, "weights of techniques: there is one");
        say(!self.conductors, "conductors: all surfaces are diffuse");
        say(!self.media, "media: none");
        say(!self.meshes, "hierarchy of boxes: no triangles");
        say(self.depth == Some(2), "products along paths: one scattering at most");
        lines
    }
}

/// The lines of [`explain`](Needs::explain), after "left out".
impl fmt::Display for Needs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("left out:")?;
        self.explain().iter().try_for_each(|line| write!(f, "\n  {line}"))
    }
}
