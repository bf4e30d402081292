//! What paths yield, against closed forms and references.
//!
//! # Statistics
//! H0: an estimate of N samples is normal about the right value with its own standard error and that of the
//! reference. A test may compare up to 400 numbers; α = 10⁻⁹ for all of them, so 2.5·10⁻¹² for each (Šidák),
//! which is 7.0 standard errors. On top, rounding of `f32`: 4·10⁻⁶ of the value.

mod features;
#[path = "../support/mod.rs"]
mod support;
mod terms;

use ratiocv_core::moments::{Accumulate, Comoments, Variance, Widened};
use ratiocv_core::{Draw, Estimator, Integrals, Lanes, Plain, RatioOfMeans, Spectrum};
use ratiocv_scene::{BLOCK, Colour, Description, LightChoice, Mixture, Needs, Options, Samples, Scene};
use support::{ALL, EXACT, EXACT_PIXELS, PIXELS, REFERENCES, built};

type Rgb = Spectrum<f32, 3>;
type Wide = Spectrum<f64, 3>;

const THRESHOLD: f64 = 7.0;
const ROUNDING: f64 = 4e-6;

const PLAIN: Options = Options { auxiliary: false, choice: LightChoice::Local, mixture: Mixture::L2 };
const RATIO: Options = Options { auxiliary: true, ..PLAIN };

/// Value and standard error per channel.
type Measured = [[f64; 2]; 3];

/// Plain Monte Carlo of the light of a pixel; in a channel that never saw any, the error is 0.
fn plain_pixel<C: Colour>(scene: &Scene<C>, pixel: [u32; 2], blocks: u64, count: usize, seed: u64) -> Measured {
    let mut samples = Samples::new(scene);
    let mut moments = Variance::<Wide, 0>::default();
    for block in 0..blocks {
        scene.trace(pixel, block, count, seed, &mut samples);
        for i in 0..count {
            let all = (0..scene.terms().len())
                .fold(samples.plain()[i].f.widen(), |sum, term| sum + samples.pairs(term)[i].f.widen());
            let all = Wide::from_fn(|channel| all.get(channel % C::LANES));
            moments.add(Draw { f: all, h: [] });
        }
    }
    let estimate = Plain.estimate(&moments, &Integrals::NONE).expect("enough samples");
    core::array::from_fn(|c| {
        let (value, error) = (estimate.value.get(c), estimate.std_error.get(c));
        [value, if value == 0.0 { 0.0 } else { error }]
    })
}

/// The mean of the whole image.
fn plain_image<C: Colour>(scene: &Scene<C>, count: usize, seed: u64) -> Measured {
    let [width, height] = scene.size();
    let mut sums = [[0.0; 2]; 3];
    for y in 0..height {
        for x in 0..width {
            for (sum, [value, error]) in sums.iter_mut().zip(plain_pixel(scene, [x, y], 1, count, seed)) {
                sum[0] += value;
                sum[1] += error * error;
            }
        }
    }
    let pixels = f64::from(width) * f64::from(height);
    sums.map(|[value, square]| [value / pixels, libm::sqrt(square) / pixels])
}

/// The ratio of means, summed over the terms; errors add up at worst.
fn ratio_pixel(scene: &Scene<Rgb>, pixel: [u32; 2], blocks: u64, seed: u64) -> Measured {
    let mut samples = Samples::new(scene);
    let mut plain = Variance::<Wide, 0>::default();
    let mut moments = vec![Widened::<Rgb, Comoments<Wide>>::default(); scene.terms().len()];
    for block in 0..blocks {
        scene.trace(pixel, block, BLOCK, seed, &mut samples);
        samples.plain().iter().for_each(|draw| plain.add(Draw { f: draw.f.widen(), h: [] }));
        for (term, moments) in moments.iter_mut().enumerate() {
            moments.add_batch(samples.pairs(term));
        }
    }
    let plain = Plain.estimate(&plain, &Integrals::NONE).expect("enough samples");
    let mut sum: Measured = core::array::from_fn(|c| [plain.value.get(c), plain.std_error.get(c).max(0.0)]);
    for moments in &moments {
        let estimate = RatioOfMeans.estimate(moments, &Integrals::ONE).expect("enough samples");
        for (c, sum) in sum.iter_mut().enumerate() {
            let (value, error) = (estimate.value.get(c), estimate.std_error.get(c));
            sum[0] += value;
            sum[1] += if value == 0.0 { 0.0 } else { error };
        }
    }
    sum
}

#[track_caller]
fn agree(ours: Measured, right: [f64; 3], errors: [f64; 3], what: &str) {
    for (c, [value, error]) in ours.into_iter().enumerate() {
        let allowed = THRESHOLD * libm::hypot(error, errors[c]) + ROUNDING * right[c].abs();
        let off = (value - right[c]).abs();
        assert!(off <= allowed, "{what}, channel {c}: {value} ± {error} should be {} ± {}", right[c], errors[c]);
    }
}

fn scene(name: &str, options: Options) -> Scene<Rgb> {
    Scene::new(&built(name), &options).expect("a sound scene")
}

/// Fewer samples where paths are long.
fn count(name: &str) -> usize {
    if name == "S4e" { 8 } else { 32 }
}

#[test]
fn images_and_pixels_with_closed_forms() {
    for exact in &EXACT {
        for options in [PLAIN, RATIO] {
            let (name, scene) = (exact.name, scene(exact.name, options));
            agree(plain_image(&scene, count(name), 1), exact.mean, [0.0; 3], name);
            for (pixel, right) in EXACT_PIXELS.into_iter().zip(exact.pixels) {
                let what = format!("{name} {pixel:?}");
                agree(plain_pixel(&scene, pixel, 64, BLOCK, 2), right, [0.0; 3], &what);
                if options.auxiliary {
                    agree(ratio_pixel(&scene, pixel, 256, 3), right, [0.0; 3], &what);
                }
            }
        }
    }
}

#[test]
fn image_means_of_references() {
    for reference in &REFERENCES {
        let [right, errors] = reference.mean;
        agree(plain_image(&scene(reference.name, PLAIN), 32, 4), right, errors, reference.name);
        agree(plain_image(&scene(reference.name, RATIO), 32, 5), right, errors, reference.name);
    }
}

/// Also those whose own kernel combines fewer techniques.
#[test]
fn image_means_with_everything() {
    for reference in &REFERENCES {
        let [right, errors] = reference.mean;
        let scene = scene(reference.name, RATIO).with_everything();
        agree(plain_image(&scene, 16, 15), right, errors, reference.name);
    }
}

#[test]
fn scene_files_are_these_scenes() {
    for reference in &REFERENCES {
        let file = Description::built_in(reference.name).expect("a scene that comes with the crate");
        let scene = Scene::<Rgb>::new(&file, &PLAIN).expect("a sound scene");
        agree(plain_image(&scene, 8, 14), reference.mean[0], reference.mean[1], reference.name);
    }
}

#[test]
fn pixels_of_references() {
    for reference in &REFERENCES {
        let [plain, ratio] = [PLAIN, RATIO].map(|options| scene(reference.name, options));
        for (pixel, [right, errors]) in PIXELS.into_iter().zip(reference.pixels) {
            let what = format!("{} {pixel:?}", reference.name);
            agree(plain_pixel(&plain, pixel, 256, BLOCK, 6), right, errors, &what);
            agree(plain_pixel(&ratio, pixel, 256, BLOCK, 7), right, errors, &what);
            agree(ratio_pixel(&ratio, pixel, 512, 8), right, errors, &what);
        }
    }
}

#[test]
fn every_choice_of_lights_has_the_same_mean() {
    let (name, [right, errors]) = (REFERENCES[0].name, REFERENCES[0].mean);
    for choice in [LightChoice::Uniform, LightChoice::Power, LightChoice::Local] {
        for mixture in [Mixture::Luminance, Mixture::L2, Mixture::Uniform] {
            let options = Options { auxiliary: true, choice, mixture };
            let what = format!("{name} {choice:?} {mixture:?}");
            agree(plain_image(&scene(name, options), 16, 9), right, errors, &what);
            means_of_h(name, options, 4);
        }
    }
}

fn means_of_h(name: &str, options: Options, count: usize) {
    means_of_h_in(&scene(name, options), count, name);
}

/// The mean of h over all pixels, for each term.
fn means_of_h_in(scene: &Scene<Rgb>, count: usize, what: &str) {
    let mut samples = Samples::new(scene);
    let mut moments = vec![Variance::<Wide, 0>::default(); scene.terms().len()];
    let [width, height] = scene.size();
    for y in 0..height {
        for x in 0..width {
            scene.trace([x, y], 0, count, 10, &mut samples);
            for (term, moments) in moments.iter_mut().enumerate() {
                samples.pairs(term).iter().for_each(|draw| moments.add(Draw { f: draw.h[0].widen(), h: [] }));
            }
        }
    }
    for (moments, term) in moments.iter().zip(scene.terms()) {
        let estimate = Plain.estimate(moments, &Integrals::NONE).expect("enough samples");
        let h = core::array::from_fn(|c| [estimate.value.get(c), estimate.std_error.get(c)]);
        agree(h, [1.0; 3], [0.0; 3], &format!("{what}, h of {term}"));
    }
}

#[test]
fn every_auxiliary_has_the_mean_1() {
    for name in ALL {
        means_of_h(name, RATIO, count(name));
    }
}

#[test]
fn one_channel_is_the_first_of_three() {
    let white = built("S4a");
    assert_eq!(Needs::of(&white, &RATIO).channels, 1);
    let mut grey = built("S2");
    // White walls, grey light, grey conductors.
    for shape in &mut grey.shapes {
        if let Some(emission) = &mut shape.emission {
            *emission = glam::Vec3::splat(5.0);
        }
        if let ratiocv_scene::Material::Diffuse { reflectance } = &mut shape.surface.material {
            *reflectance = glam::Vec3::splat(reflectance.x);
        }
        if let ratiocv_scene::Material::Conductor { roughness, .. } = &mut shape.surface.material {
            *roughness = ratiocv_scene::Roughness::Grey(0.2);
        }
    }
    for description in [white, grey] {
        let one = Scene::<f32>::new(&description, &RATIO).expect("a sound scene");
        let three = Scene::<Rgb>::new(&description, &RATIO).expect("a sound scene");
        assert!(three.terms().is_empty());
        let right = plain_image(&three, 8, 11).map(|[value, error]| [value, error]);
        agree(plain_image(&one, 8, 12), right.map(|m| m[0]), right.map(|m| m[1]), "one channel");
    }
}

#[test]
fn samples_depend_on_seed_pixel_block_and_number_alone() {
    let scene = scene("S2", RATIO);
    let of = |pixel, block, count, seed| {
        let mut samples = Samples::new(&scene);
        scene.trace(pixel, block, count, seed, &mut samples);
        samples
    };
    let all = of([40, 80], 3, BLOCK, 7);
    let some = of([40, 80], 3, 5, 7);
    assert_eq!((some.count(), all.count()), (5, BLOCK));
    assert_eq!(all.plain()[..5], *some.plain());
    for term in 0..scene.terms().len() {
        assert_eq!(all.pairs(term)[..5], *some.pairs(term));
    }
    for other in [of([41, 80], 3, 5, 7), of([40, 80], 4, 5, 7), of([40, 80], 3, 5, 8)] {
        assert_ne!(other.pairs(0), some.pairs(0));
    }
}

/// A cube of 12 triangles is the cube.
#[test]
fn meshes_scatter_and_emit_like_what_they_are() {
    use glam::{Affine3A, Quat, Vec3, vec3};
    use ratiocv_scene::{Geometry, Mesh};
    let to_world =
        Affine3A::from_scale_rotation_translation(Vec3::splat(0.5), Quat::from_rotation_y(0.4), vec3(0.0, 0.9, 0.0));
    let positions = (0..8).map(|i| {
        let side = |bit: i32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        to_world.transform_point3(vec3(side(0), side(1), side(2)))
    });
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    let mesh = Mesh { positions: positions.collect(), normals: Vec::new(), triangles };
    for emission in [None, Some(vec3(3.0, 2.0, 1.0))] {
        let images = [Geometry::Cube(to_world), Geometry::Mesh(mesh.clone())].map(|geometry| {
            let mut description: Description = built("S1");
            description.max_depth = Some(3);
            description.shapes[1].geometry = geometry;
            description.shapes[1].emission = emission;
            let scene = Scene::<Rgb>::new(&description, &RATIO).expect("a sound scene");
            plain_image(&scene, 16, 13)
        });
        let [cube, mesh] = images;
        agree(mesh, cube.map(|m| m[0]), cube.map(|m| m[1]), "mesh and cube");
    }
}
