//! The example renderer of the core: a right picture, with less noise than plain, and an auxiliary of mean 1.

#[allow(missing_docs, unreachable_pub, dead_code, reason = "the example as it is")]
#[path = "../core/examples/renderer/render.rs"]
mod render;
#[allow(missing_docs, unreachable_pub, dead_code, reason = "the example as it is")]
#[path = "../core/examples/renderer/scene.rs"]
mod scene;

use ratiocv_core::moments::{Accumulate, Comoments, HasMeans, Moments, Sums, Widened};
use ratiocv_core::{
    Draw, Estimate, Estimator, Film, Integrals, Lanes, MeanOfRatios, Plain, RatioOfMeans, Reads, Spectrum,
};
use render::{render, sample};
use scene::{BALLS, EYE, LIGHTS, Random, Rgb, SKY, Sphere, camera};

const WIDTH: usize = 48;
const HEIGHT: usize = 32;
const PIXELS: usize = WIDTH * HEIGHT;

type Vector = [f64; 3];

fn wide(v: Rgb) -> Vector {
    v.0.map(f64::from)
}

fn minus(a: Vector, b: Vector) -> Vector {
    core::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// The ball that a ray meets first, and where; `wider` balls are met too.
fn met(from: Vector, direction: Vector, wider: f64) -> Option<(f64, &'static Sphere)> {
    let hits = BALLS.iter().filter_map(|ball| {
        let back = minus(from, wide(ball.centre));
        let along = dot(back, direction);
        let radius = f64::from(ball.radius) * (1.0 + wider);
        let distance = -along - libm::sqrt(along * along - dot(back, back) + radius * radius);
        (distance > 1e-3).then_some((distance, ball))
    });
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The colour of a pixel, wherever both lights are above the horizon and the whole of each can be seen, or where
/// the ray misses: albedo·Σ radiance·r²·cos θ/d², exact for spheres (Lambert 1760).
fn closed_form(pixel: usize) -> Option<Vector> {
    let direction = wide(camera(pixel % WIDTH, pixel / WIDTH, WIDTH, HEIGHT));
    let Some((distance, ball)) = met(wide(EYE), direction, 0.0) else {
        // Near a ball, single and double precision may disagree about the miss.
        return met(wide(EYE), direction, 1e-3).is_none().then_some(wide(SKY));
    };
    let point: Vector = core::array::from_fn(|i| wide(EYE)[i] + distance * direction[i]);
    let normal = minus(point, wide(ball.centre)).map(|x| x / f64::from(ball.radius));
    if dot(normal, direction) > -0.05 {
        return None; // grazing: the place of the hit is ill-conditioned
    }
    let mut colour = [0.0; 3];
    for light in &LIGHTS {
        let to_light = minus(wide(light.centre), point);
        let (distance, radius) = (libm::sqrt(dot(to_light, to_light)), f64::from(light.radius));
        let cosine = dot(normal, to_light) / distance;
        // A blocker that is not wider than its distance from the point leaves the cone to the light free if the
        // blocker grown by the light's radius does not meet the axis.
        let blocked = BALLS.iter().filter(|other| !core::ptr::eq(*other, ball)).any(|other| {
            let to_ball = minus(wide(other.centre), point);
            let along = dot(to_ball, to_light) / distance;
            along > 0.0 && dot(to_ball, to_ball) - along * along < (f64::from(other.radius) + radius).powi(2)
        });
        if cosine <= radius / distance || blocked {
            return None;
        }
        for (channel, colour) in colour.iter_mut().enumerate() {
            let sent = wide(light.colour)[channel] * wide(ball.colour)[channel];
            *colour += sent * (radius / distance) * (radius / distance) * cosine;
        }
    }
    Some(colour)
}

fn rendered<M: Accumulate<Draw<Rgb>> + Moments + Copy + Default>(spp: usize, seed: u64) -> Vec<M> {
    let mut memory = vec![M::default(); PIXELS];
    render(&mut Film::new(&mut memory), WIDTH, spp, &mut Random(seed)).expect("a film of whole rows");
    memory
}

/// The ratio's and plain's estimate of the same draws.
fn both<M: Moments<Channel: HasMeans>>(pixel: &M) -> [Estimate<M::Lanes>; 2] {
    let ratio = RatioOfMeans.defensive(0.01).expect("a weight");
    let one = Integrals::ONE;
    [ratio.estimate(pixel, &one).expect("draws"), Plain.estimate(pixel, &one).expect("draws")]
}

/// The known pixels, some of the sky and some of the balls, with their colours.
fn known() -> Vec<(usize, Vector)> {
    (0..PIXELS).filter_map(|pixel| closed_form(pixel).map(|colour| (pixel, colour))).collect()
}

/// In P known pixels of the balls, z = (estimate − closed form)/(standard error) of N = 1024 draws: Σz/√P and
/// (Σz² − P)/√(2P) are about standard normal. 2 estimators, 3 channels, 2 statistics; 5.2 for each, α = 2e-7 each.
#[test]
fn the_picture_is_the_closed_form() {
    let film: Vec<Comoments<Rgb>> = rendered(1024, 1);
    let (known, sky) = (known(), wide(SKY));
    let lit: Vec<_> = known.iter().filter(|(_, colour)| *colour != sky).collect();
    for (pixel, _) in known.iter().filter(|(_, colour)| *colour == sky) {
        assert!(both(&film[*pixel]).iter().all(|estimate| estimate.value.0 == sky), "sky: pixel {pixel}");
    }
    assert!(lit.len() >= 400 && known.len() - lit.len() >= 400, "{} lit of {}", lit.len(), known.len());
    let count = lit.len() as f64;
    for estimator in 0..2 {
        for channel in 0..3 {
            let z = lit.iter().map(|(pixel, colour)| {
                let estimate = both(&film[*pixel])[estimator].channel(channel);
                (estimate.value - colour[channel]) / estimate.std_error
            });
            let (sum, squares) = z.fold((0.0, 0.0), |(sum, squares), z| (sum + z, squares + z * z));
            let statistics = [sum / libm::sqrt(count), (squares - count) / libm::sqrt(2.0 * count)];
            println!("estimator {estimator}, channel {channel}: {statistics:.2?}");
            assert!(statistics.iter().all(|z| z.abs() <= 5.2), "{estimator}, channel {channel}: {statistics:?}");
        }
    }
}

/// The mean squared error of both estimators over `pixels`, 16 draws each, 8 pictures.
fn squared_errors(pixels: &[(usize, Vector)]) -> [f64; 2] {
    let mut errors = [0.0; 2];
    for seed in 0..8 {
        let film: Vec<Sums<Rgb>> = rendered(16, 100 + seed);
        for (pixel, colour) in pixels {
            for (error, estimate) in errors.iter_mut().zip(both(&film[*pixel])) {
                *error += (0..3).map(|i| libm::pow(estimate.value[i] - colour[i], 2.0)).sum::<f64>();
            }
        }
    }
    errors.map(|error| error / (8 * 3 * pixels.len()) as f64)
}

/// A picture by plain Monte Carlo, 8192 draws per pixel.
fn reference() -> Vec<(usize, Vector)> {
    let film: Vec<Sums<Rgb>> = rendered(8192, 2);
    film.iter().map(|pixel| both(pixel)[1].value.0).enumerate().collect()
}

/// With the whole light in view and in the whole picture, shadows and their edges included.
#[test]
fn it_has_less_noise_than_plain() {
    for (pixels, least) in [(known(), 40.0), (reference(), 15.0)] {
        let [ratio, plain] = squared_errors(&pixels);
        println!("{} pixels: {:.1} times less", pixels.len(), plain / ratio);
        assert!(plain / ratio >= least, "{plain:e}, {ratio:e}");
    }
}

/// z of the mean of each channel's h against 1, over 256 draws of each of `PIXELS` pixels.
fn z_of_h(of: impl Fn(Draw<Rgb>) -> Rgb) -> Vector {
    let (mut moments, mut random) = (Widened::<Rgb, Comoments<Spectrum<f64, 3>>>::default(), Random(3));
    for pixel in 0..PIXELS {
        let direction = camera(pixel % WIDTH, pixel / WIDTH, WIDTH, HEIGHT);
        for _ in 0..256 {
            moments.add(Draw::new(of(sample(EYE, direction, &mut random)), Rgb::ONE));
        }
    }
    let mean = Plain.estimate(&moments, &Integrals::ONE).expect("draws");
    println!("mean of h {:.4?}", mean.value);
    core::array::from_fn(|i| (mean.value[i] - 1.0) / mean.std_error[i])
}

/// 393 216 draws; 5.2 standard errors, α = 2e-7 for each channel.
#[test]
fn the_auxiliary_has_the_mean_1() {
    let z = z_of_h(|draw| draw.h[0]);
    assert!(z.iter().all(|z| z.abs() <= 5.2), "{z:?}");
    // The mistake that the page on embedding warns of is seen at once.
    let zeroed = z_of_h(|draw| if draw.f == Rgb::ZERO { Rgb::ZERO } else { draw.h[0] });
    assert!(zeroed.iter().all(|z| *z < -5.2), "{zeroed:?}");
}

/// The mean colour of a picture, made by `estimator` of what `of` leaves of 256 draws per pixel, over the right
/// one's, minus 1.
fn bias<M: Accumulate<Draw<Rgb>> + Moments<Lanes = Rgb>>(
    right: Vector,
    estimator: &impl Estimator<M::Channel>,
    empty: impl Fn() -> M,
    of: impl Fn(Draw<Rgb>) -> Draw<Rgb>,
) -> Vector {
    let (mut random, mut mean) = (Random(4), [0.0; 3]);
    for pixel in 0..PIXELS {
        let direction = camera(pixel % WIDTH, pixel / WIDTH, WIDTH, HEIGHT);
        let mut moments = empty();
        (0..256).for_each(|_| moments.add(of(sample(EYE, direction, &mut random))));
        let value = estimator.estimate(&moments, &Integrals::ONE).expect("draws").value;
        mean = core::array::from_fn(|i| mean[i] + value[i] / PIXELS as f64);
    }
    core::array::from_fn(|i| mean[i] / right[i] - 1.0)
}

/// What the mistakes that the page on embedding warns of do to the mean of a whole picture. The standard error of
/// that mean is some 1e-4.
#[test]
fn mistakes_are_biases() {
    let reference = reference();
    let right = core::array::from_fn(|i| reference.iter().map(|(_, colour)| colour[i]).sum::<f64>() / PIXELS as f64);
    let ratio = RatioOfMeans.defensive(0.01).expect("a weight");
    let zeroed = |draw: Draw<Rgb>| if draw.f == Rgb::ZERO { Draw::ZERO } else { draw };
    let clamped = |draw: Draw<Rgb>| Draw { f: Spectrum(draw.f.0.map(|f| f.min(1.0))), ..draw };
    let none = bias(right, &ratio, Sums::default, |draw| draw);
    let zeroed = bias(right, &ratio, Sums::default, zeroed);
    let clamped = bias(right, &ratio, Sums::default, clamped);
    let ratios = bias(right, &MeanOfRatios, || MeanOfRatios.value(&Integrals::ONE), |draw| draw);
    println!("none {none:.4?}, zeroed {zeroed:.4?}, clamped {clamped:.4?}, mean of ratios {ratios:.4?}");
    assert!(none.iter().all(|bias| bias.abs() <= 1e-3), "{none:?}");
    assert!(zeroed.iter().all(|bias| *bias >= 0.03), "{zeroed:?}");
    assert!(clamped[0] <= -0.02 && clamped[2] <= -0.08, "{clamped:?}");
    assert!(ratios[0] >= 3e-3 && ratios[2] >= 3e-3, "{ratios:?}");
}

/// The page's table of costs repeats that of ARCHITECTURE.md, which is measured.
#[test]
fn the_costs_are_the_measured_ones() {
    fn cells<'a>(text: &'a str, start: &str) -> Vec<&'a str> {
        let row = text.lines().find(|line| line.starts_with(start));
        row.unwrap_or_else(|| panic!("no row {start}")).split('|').map(str::trim).collect()
    }
    let (page, measured) = (include_str!("../core/src/embedding.md"), include_str!("../ARCHITECTURE.md"));
    for (wanted, id, tier) in [
        ("plain Monte Carlo", "mc", 0),
        ("a picture |", "ratio", 0),
        ("a picture and its error", "ratio", 1),
        ("no bias", "mickey", 0),
        ("a cheap error bar", "jackknife", 0),
        ("no idea", "choose", 0),
    ] {
        let (ours, measured) = (cells(page, &format!("| {wanted}")), cells(measured, &format!("| `{id}`")));
        // RGB: bytes and instructions, of the value and with the error bar.
        let costs = [4, 5].map(|column| measured[column].split(", ").nth(tier).expect("two tiers"));
        assert_eq!(ours[4..6], costs, "{wanted}");
    }
}
