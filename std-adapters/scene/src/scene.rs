//! A scene that is ready to be traced.

use crate::camera::Camera;
use crate::colour::{Colour, PathColour};
use crate::description::{Description, Light};
use crate::error::SceneError;
use crate::geometry::{Beam, Geometry, NONE, Nearest};
use crate::light::{Emitter, Lights};
use crate::material::{Surface, within};
use crate::medium::Filled;
use crate::needs::{Needs, Options};
use crate::path::{BLOCK, Block, Kernel, Samples, Term, Terms};
use crate::planted::planted;
use ratiocv_core::Lanes;

/// Where paths without a limit begin to end by Russian roulette if the description says nothing: between
/// white walls they would never end.
const ENDLESS: usize = 64;

/// A scene, prepared, with the kernel that it needs.
///
/// `C` is `Spectrum<f32, 3>`, or `f32` if [`Needs::channels`] is 1.
#[derive(Debug)]
pub struct Scene<C: Colour> {
    pub(crate) camera: Camera,
    pub(crate) geometry: Geometry,
    /// By number of the geometry.
    pub(crate) surfaces: Vec<Surface<C::OnPath>>,
    pub(crate) lights: Lights<C::OnPath>,
    pub(crate) environment: C::OnPath,
    pub(crate) media: Vec<Filled<C::OnPath>>,
    pub(crate) max_depth: usize,
    pub(crate) roulette_depth: usize,
    pub(crate) terms: Terms,
    needs: Needs,
    size: [u32; 2],
    kernel: Kernel<C>,
}

impl<C: Colour> Scene<C> {
    /// Prepares a scene.
    ///
    /// Without a limit of depth, Russian roulette begins at depth 64 at the latest. Roughness below 0.001 is taken
    /// for 0.001. An error says what is wrong with the description, and with which of its shapes or lights.
    ///
    /// ```
    /// use ratiocv_core::Spectrum;
    /// use ratiocv_scene::{Description, Samples, Scene};
    /// // A ball that reflects 0.2, 0.5 and 0.8 of light of 1, 0.5 and 2.
    /// let scene = Scene::<Spectrum<f32, 3>>::new(&Description::built_in("S4b")?, &Default::default())?;
    /// let mut samples = Samples::new(&scene);
    /// scene.trace([64, 64], 0, 16, 1, &mut samples); // 16 samples of the pixel in the middle
    /// for light in samples.plain() {
    ///     assert!((light.f[2] - 1.6).abs() < 1e-5);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(description: &Description, options: &Options) -> Result<Self, SceneError> {
        let needs = Needs::of(description, options);
        if C::LANES < needs.channels {
            return Err(SceneError::Channels);
        }
        if description.max_depth == Some(0) {
            return Err(SceneError::Depth);
        }
        let (geometry, order) = Geometry::new(&description.shapes)?;
        let mut lights = Lights::new(options.choice, options.mixture);
        let mut surfaces = Vec::new();
        for (number, (i, solid)) in order.iter().enumerate() {
            let mut surface = Surface::<C::OnPath>::new(&description.shapes[*i], *i)?;
            if surface.emission != <C::OnPath>::ZERO {
                let triangles = geometry.meshes.as_ref().map_or(&[][..], |meshes| meshes.triangles());
                surface.light = lights.lights.len() as u32;
                lights.push(Emitter::new(*solid, number as u32, triangles), number as u32, surface.emission);
            }
            surfaces.push(surface);
        }
        let mut media = Vec::new();
        for (i, shape) in description.shapes.iter().enumerate() {
            media.extend(Filled::new(shape, i)?);
            if shape.surface.material == crate::Material::Null && shape.emission.is_some() {
                return Err(SceneError::NullLight(i));
            }
        }
        let mut environment = <C::OnPath>::ZERO;
        for (i, light) in description.lights.iter().enumerate() {
            let sound = match *light {
                Light::Environment(radiance) => {
                    environment = environment + <C::OnPath>::of(radiance);
                    within(radiance, f32::MAX)
                }
                Light::Point { position, intensity } => {
                    if intensity != glam::Vec3::ZERO {
                        lights.push(Emitter::Point(position), NONE, <C::OnPath>::of(intensity));
                    }
                    within(intensity, f32::MAX) && position.is_finite()
                }
            };
            if !sound {
                return Err(SceneError::Light(i));
            }
        }
        if lights.lights.is_empty() && environment == <C::OnPath>::ZERO {
            return Err(SceneError::NoLight);
        }
        let depth = |depth: Option<u32>| depth.map_or(usize::MAX, |depth| depth as usize);
        let (max_depth, roulette_depth) = (depth(description.max_depth), depth(description.roulette_depth));
        Ok(Self {
            camera: Camera::new(description)?,
            geometry,
            surfaces,
            lights,
            environment,
            media,
            max_depth,
            roulette_depth: if max_depth == usize::MAX { roulette_depth.min(ENDLESS) } else { roulette_depth },
            terms: Terms::new(&needs),
            needs,
            size: description.size,
            kernel: C::kernel(&needs),
        })
    }

    /// The same with a kernel that leaves nothing out: as slow as a renderer that does not look at its scene, to
    /// measure what looking saves. Images have the same expectation; sample by sample they may differ, because more
    /// techniques may be combined.
    ///
    /// ```
    /// use ratiocv_core::Spectrum;
    /// use ratiocv_scene::{Description, Samples, Scene};
    /// let scene = Scene::<Spectrum<f32, 3>>::new(&Description::built_in("S4b")?, &Default::default())?;
    /// let scene = scene.with_everything();
    /// let mut samples = Samples::new(&scene);
    /// scene.trace([64, 64], 0, 16, 1, &mut samples);
    /// assert!((samples.plain()[3].f[2] - 1.6).abs() < 1e-5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_everything(self) -> Self {
        Self { kernel: C::everything(), ..self }
    }

    /// Whether no ray of the beam, which meets `seen`, meets anything at all. Triangles are not looked up for it.
    #[inline(always)]
    pub(crate) fn is_sky<const MEDIA: bool>(&self, beam: &Beam, seen: &Nearest) -> bool {
        let mut is_sky = seen.is_nothing() && self.geometry.meshes.is_none();
        if MEDIA {
            // A loop, because `any` would be a call, and not in lanes.
            for medium in &self.media {
                is_sky = is_sky && planted!("sky_in_media": !medium.is_met_by(beam), true);
            }
        }
        is_sky
    }

    /// What it needs, and what is left out.
    pub const fn needs(&self) -> &Needs {
        &self.needs
    }

    /// Columns and rows of the image.
    pub const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The pairs (f, h) of a sample, in the order of [`Samples::pairs`]; none in plain Monte Carlo.
    pub fn terms(&self) -> &[Term] {
        &self.terms.terms
    }

    /// Traces the first `count` samples, at most [`BLOCK`], of block `block` of a pixel, column and row from the
    /// upper left.
    ///
    /// Each (seed, pixel, block) has a random stream of its own: what a sample is depends on these and its
    /// number alone. `samples` must have been made for this scene.
    pub fn trace(&self, pixel: [u32; 2], block: u64, count: usize, seed: u64, samples: &mut Samples<C>) {
        let count = count.min(BLOCK);
        samples.begin(count);
        (self.kernel)(self, Block { pixel, block, count, seed }, samples);
    }
}
