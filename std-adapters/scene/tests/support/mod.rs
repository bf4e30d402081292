//! The scenes as descriptions, and their right answers.
#![allow(dead_code, reason = "each test program uses a part")]

use glam::{Affine3A, Vec3, vec3};
use ratiocv_scene::{Camera, Description, Filter, Geometry, Light, Material, Medium, Roughness, Shape, Surface};

pub(crate) const ALL: [&str; 14] =
    ["S1", "S1b", "S1k", "S2", "S2w", "S3", "S3m", "S4a", "S4b", "S4c", "S4d", "S4e", "S4f", "S4g"];

pub(crate) fn look_at(eye: Vec3, target: Vec3, fov: f32) -> Camera {
    let forward = (target - eye).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward);
    let to_world = Affine3A::from_cols((-right).into(), up.into(), forward.into(), eye.into());
    Camera { to_world, fov }
}

pub(crate) fn scene(camera: Camera, max_depth: Option<u32>) -> Description {
    Description {
        max_depth,
        roulette_depth: None,
        camera,
        size: [128; 2],
        filter: Filter::Box,
        samples: 64,
        shapes: Vec::new(),
        lights: Vec::new(),
    }
}

pub(crate) fn shape(geometry: Geometry, material: Material, two_sided: bool) -> Shape {
    let surface = Surface { material, two_sided };
    Shape { geometry, surface, emission: None, medium: None, flip_normals: false, visible_to_camera: true }
}

pub(crate) fn diffuse(reflectance: Vec3) -> Material {
    Material::Diffuse { reflectance }
}

pub(crate) fn sphere(center: Vec3, radius: f32) -> Geometry {
    Geometry::Sphere { center, radius }
}

pub(crate) fn lit(geometry: Geometry, emission: Vec3) -> Shape {
    Shape { emission: Some(emission), ..shape(geometry, diffuse(Vec3::ZERO), false) }
}

pub(crate) fn grey(albedo: f32) -> Material {
    diffuse(Vec3::splat(albedo))
}

/// center ± u ± v with the normal u × v.
pub(crate) fn quad(center: Vec3, u: Vec3, v: Vec3) -> Geometry {
    let n = u.cross(v).normalize();
    Geometry::Rectangle(Affine3A::from_cols(u.into(), v.into(), n.into(), center.into()))
}

fn floor(y: f32) -> Shape {
    shape(quad(vec3(0.0, y, 0.0), vec3(0.0, 0.0, 20.0), vec3(20.0, 0.0, 0.0)), grey(0.5), true)
}

fn conductor(reflectance: f32, roughness: Vec3) -> Material {
    Material::Conductor { roughness: Roughness::Chromatic(roughness), reflectance: Vec3::splat(reflectance) }
}

fn filled(geometry: Geometry, extinction: Vec3, albedo: f32) -> Shape {
    let medium = Some(Medium { extinction, albedo: Vec3::splat(albedo) });
    Shape { medium, ..shape(geometry, Material::Null, true) }
}

fn s1(radius: f32, radiances: [Vec3; 3], ball: bool) -> Description {
    let mut s = scene(look_at(vec3(0.0, 5.0, 6.0), vec3(0.0, 0.6, 0.0), 36.0), Some(2));
    s.shapes.push(floor(0.0));
    if ball {
        s.shapes.push(shape(sphere(Vec3::Y, 1.0), grey(0.7), false));
    }
    let places = [vec3(-3.0, 4.0, 2.0), vec3(3.0, 4.0, 2.0), vec3(0.0, 5.0, -3.0)];
    for (place, radiance) in places.into_iter().zip(radiances) {
        s.shapes.push(lit(sphere(place, radius), radiance));
    }
    s
}

fn s1k() -> Description {
    let mut s = s1(0.1, [Vec3::ONE; 3], true);
    s.shapes.truncate(2);
    for i in 0..24 {
        let q = 3.0 + 2.0 * f64::from(i % 2);
        let w = core::f64::consts::TAU * f64::from(i) / 24.0;
        let place = vec3((q * libm::cos(w)) as f32, 3.0 + (i % 3) as f32, (q * libm::sin(w)) as f32);
        let radiance = |j: i32| {
            let hue = core::f64::consts::TAU * (0.381_966 * f64::from(i) - f64::from(j) / 3.0);
            let lobe = libm::cos(hue).max(0.0);
            (500.0 * (0.02 + lobe * lobe)) as f32
        };
        let light = lit(sphere(place, 0.1), vec3(radiance(0), radiance(1), radiance(2)));
        s.shapes.push(Shape { visible_to_camera: false, ..light });
    }
    s
}

fn s2(half: f32, radiance: Vec3) -> Description {
    let mut s = scene(look_at(vec3(0.0, 0.1, 3.9), vec3(0.0, -0.45, 0.0), 30.0), Some(4));
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    let middle = vec3(0.0, 0.0, 0.25);
    let depth = z * 1.25;
    let [white, red, green] = [Vec3::splat(0.73), vec3(0.63, 0.065, 0.05), vec3(0.14, 0.45, 0.091)].map(diffuse);
    s.shapes.push(shape(quad(middle - y, depth, x), white, true));
    s.shapes.push(shape(quad(middle + y, x, depth), white, true));
    s.shapes.push(shape(quad(middle - x, y, depth), red, true));
    s.shapes.push(shape(quad(middle + x, depth, y), green, true));
    s.shapes.push(shape(quad(-z, x, y), white, true));
    s.shapes.push(lit(quad(y * 0.99, x * half, z * half), radiance));
    let ball = |center, radius, roughness| shape(sphere(center, radius), conductor(0.9, roughness), false);
    s.shapes.push(ball(vec3(-0.42, -0.55, -0.25), 0.45, vec3(0.05, 0.2, 0.5)));
    s.shapes.push(ball(vec3(0.5, -0.6, 0.45), 0.4, vec3(0.4, 0.15, 0.05)));
    s
}

const EXTINCTION: Vec3 = vec3(0.2, 1.0, 5.0);

fn s3(max_depth: u32) -> Description {
    let mut s = scene(look_at(vec3(0.0, 2.5, 5.0), vec3(0.0, -0.3, 0.0), 36.0), Some(max_depth));
    s.shapes.push(filled(Geometry::Cube(Affine3A::IDENTITY), EXTINCTION, 0.9));
    s.shapes.push(floor(-1.5));
    s.shapes.push(lit(sphere(vec3(1.5, 3.0, 2.0), 0.5), Vec3::splat(40.0)));
    s
}

fn s4(max_depth: Option<u32>, ball: Shape, environment: Vec3) -> Description {
    let mut s = scene(look_at(vec3(0.0, 0.0, 4.0), Vec3::ZERO, 40.0), max_depth);
    s.shapes.push(ball);
    s.lights.push(Light::Environment(environment));
    s
}

pub(crate) fn built(name: &str) -> Description {
    let ball = || sphere(Vec3::ZERO, 1.0);
    let coloured = diffuse(vec3(0.2, 0.5, 0.8));
    match name {
        "S1" | "S4f" => {
            let radiances = [vec3(3000.0, 5.0, 6.0), vec3(3.0, 3000.0, 4.0), vec3(4.8, 5.8, 3000.0)];
            s1(0.1, radiances, name == "S1")
        }
        "S1b" => s1(0.5, [vec3(120.0, 0.2, 0.24), vec3(0.12, 120.0, 0.16), vec3(0.192, 0.232, 120.0)], true),
        "S1k" => s1k(),
        "S2" => s2(0.25, vec3(17.0, 12.0, 4.0)),
        "S2w" => s2(0.9, vec3(1.3, 0.93, 0.31)),
        "S3" => s3(2),
        "S3m" => s3(6),
        "S4a" => s4(Some(2), shape(ball(), grey(1.0), false), Vec3::ONE),
        "S4b" => s4(Some(2), shape(ball(), coloured, false), vec3(1.0, 0.5, 2.0)),
        "S4c" => {
            let mut s = s4(Some(5), lit(sphere(Vec3::ZERO, 10.0), Vec3::ONE), Vec3::ZERO);
            s.lights.clear();
            s.shapes[0].flip_normals = true;
            s.shapes[0].surface.material = coloured;
            s
        }
        "S4d" => s4(Some(2), filled(ball(), EXTINCTION, 0.0), Vec3::ONE),
        "S4e" => s4(None, filled(ball(), EXTINCTION, 1.0), Vec3::ONE),
        "S4g" => s4(Some(2), shape(ball(), conductor(1.0, vec3(0.05, 0.2, 0.5)), false), Vec3::ONE),
        _ => panic!("no scene {name}"),
    }
}

/// An image mean per channel and its standard error, and five pixels likewise, in the order of [`PIXELS`].
pub(crate) struct Reference {
    pub(crate) name: &'static str,
    pub(crate) mean: [[f64; 3]; 2],
    pub(crate) pixels: [[[f64; 3]; 2]; 5],
}

/// Column and row.
pub(crate) const PIXELS: [[u32; 2]; 5] = [[64, 64], [32, 100], [100, 40], [64, 100], [40, 70]];

/// By an independent implementation.
pub(crate) const REFERENCES: [Reference; 7] = [
    Reference {
        name: "S1",
        mean: [[0.32411802, 0.32440864, 0.22576346], [7.89805711e-07, 7.87908954e-07, 7.95706212e-07]],
        pixels: [
            [[0.49141574, 0.52747915, 0.00168399], [8.36907068e-05, 8.71078116e-05, 1.95778645e-07]],
            [[0.66205528, 0.31566803, 0.0017429], [2.00144853e-05, 1.47471339e-05, 4.20430207e-08]],
            [[0.1201383, 0.23095955, 0.4929143], [7.30812454e-06, 1.49164733e-05, 1.04244531e-05]],
            [[0.46379422, 0.46972272, 0.00155192], [1.83514247e-05, 1.90976458e-05, 4.23646384e-08]],
            [[0.45766828, 0.00150863, 0.38723325], [7.58282889e-05, 7.58986377e-07, 0.000332386617]],
        ],
    },
    Reference {
        name: "S1b",
        mean: [[0.32432565, 0.3246163, 0.2262571], [1.01447567e-06, 1.01417046e-06, 1.03092151e-06]],
        pixels: [
            [[0.49154969, 0.52764312, 0.00168448], [0.000243885497, 0.000247057546, 5.91734641e-07]],
            [[0.66211675, 0.3156746, 0.00284001], [7.18890739e-05, 5.26193808e-05, 6.01941827e-05]],
            [[0.0899296, 0.23095689, 0.49285696], [0.000201100625, 4.12750561e-05, 3.28057956e-05]],
            [[0.46385073, 0.46981556, 0.00155215], [6.47228725e-05, 6.8663638e-05, 1.60293306e-07]],
            [[0.45770659, 0.00150841, 0.3870834], [9.44954875e-05, 5.96931522e-07, 0.000256886393]],
        ],
    },
    Reference {
        name: "S1k",
        mean: [[0.31189341, 0.32158402, 0.29187361], [1.34677527e-06, 1.1615778e-06, 1.30682716e-06]],
        pixels: [
            [[0.2512372, 0.57754261, 0.30667461], [6.01172852e-05, 0.000112766216, 7.34589441e-05]],
            [[0.25130568, 0.35619751, 0.33744176], [1.16403273e-05, 3.44434841e-05, 2.5484289e-05]],
            [[0.48592724, 0.3414576, 0.27297051], [4.66817651e-05, 1.79709988e-05, 1.97358835e-05]],
            [[0.28761452, 0.30154715, 0.28675921], [2.71496e-05, 3.84454375e-05, 2.05380424e-05]],
            [[0.28565922, 0.18852743, 0.26375387], [0.00068793, 0.0003043, 0.00044404]],
        ],
    },
    Reference {
        name: "S2",
        mean: [[0.19572824, 0.12736601, 0.03559747], [4.00918153e-05, 1.02250682e-05, 7.13995289e-06]],
        pixels: [
            [[0.14234787, 0.09368292, 0.0258651], [0.004345, 0.00106492, 0.00118622]],
            [[0.13721299, 0.07773414, 0.02323626], [0.00220609, 0.00092131, 0.00026568]],
            [[0.20698756, 0.16019708, 0.04435604], [0.0029246, 0.00102755, 0.00061008]],
            [[0.30395292, 0.21183104, 0.06768709], [0.00284162, 0.00150993, 0.00079047]],
            [[0.00473264, 0.02273458, 0.01065659], [0.0001001, 0.00070856, 0.00141724]],
        ],
    },
    Reference {
        name: "S2w",
        mean: [[0.16930638, 0.11145659, 0.031203], [1.16458442e-05, 6.11184714e-06, 2.25463966e-06]],
        pixels: [
            [[0.11121163, 0.07497666, 0.02081012], [0.00147287, 0.00053195, 0.00036422]],
            [[0.14422572, 0.0864511, 0.02672989], [0.0010846, 0.00061401, 0.00019606]],
            [[0.1679915, 0.13167911, 0.03630043], [0.00105793, 0.00066502, 0.00022012]],
            [[0.21032355, 0.14783377, 0.04658807], [0.00110128, 0.00076641, 0.00028038]],
            [[0.00471119, 0.02415388, 0.01223419], [8.01743501e-05, 0.000381192476, 0.0002522165]],
        ],
    },
    Reference {
        name: "S3",
        mean: [[0.08956634, 0.08360155, 0.07729962], [3.44304856e-06, 4.27061026e-06, 4.3652231e-06]],
        pixels: [
            [[0.08113304, 0.06341784, 0.05390575], [0.00036339, 0.00070165, 0.0008542]],
            [[0.09590084, 0.03412581, 0.02440704], [0.00015051, 0.00029591, 0.00037696]],
            [[0.08738728, 0.16628738, 0.13787998], [0.00114172, 0.00137473, 0.00109155]],
            [[0.12145813, 0.04390746, 0.0297292], [0.00018231, 0.00034346, 0.00043209]],
            [[0.06746511, 0.04471714, 0.04047886], [0.00030156, 0.0004663, 0.00056369]],
        ],
    },
    Reference {
        name: "S3m",
        mean: [[0.10028604, 0.12142999, 0.1291377], [6.11094804e-06, 9.57957076e-06, 1.03595394e-05]],
        pixels: [
            [[0.11060541, 0.15644863, 0.13718992], [0.00127065, 0.00164614, 0.00164263]],
            [[0.1075911, 0.06476111, 0.07452248], [0.00047653, 0.00088578, 0.00105512]],
            [[0.10197957, 0.25887146, 0.35040904], [0.00191435, 0.00283499, 0.00251976]],
            [[0.1400344, 0.090533, 0.09414586], [0.00072241, 0.00117762, 0.00131401]],
            [[0.0915084, 0.11420591, 0.1041934], [0.00089153, 0.00150579, 0.00144681]],
        ],
    },
];

/// An image mean and the pixels [`EXACT_PIXELS`], exact to the digits given.
pub(crate) struct Exact {
    pub(crate) name: &'static str,
    pub(crate) mean: [f64; 3],
    pub(crate) pixels: [[f64; 3]; 3],
}

/// Column and row.
pub(crate) const EXACT_PIXELS: [[u32; 2]; 3] = [[64, 64], [90, 50], [0, 0]];

const fn everywhere(name: &'static str, value: [f64; 3]) -> Exact {
    Exact { name, mean: value, pixels: [value; 3] }
}

/// Closed forms and quadrature.
pub(crate) const EXACT: [Exact; 7] = [
    everywhere("S4a", [1.0; 3]),
    Exact {
        name: "S4b",
        mean: [0.68380184, 0.40118808, 1.84190092],
        pixels: [[0.2, 0.25, 1.6], [0.2, 0.25, 1.6], [1.0, 0.5, 2.0]],
    },
    everywhere("S4c", [1.2496, 1.9375, 3.3616]),
    Exact {
        name: "S4d",
        mean: [0.90992488, 0.72427228, 0.61311641],
        pixels: [
            [6.70366291e-01, 1.35381976e-01, 4.54783239e-05],
            [7.42325817e-01, 2.25421268e-01, 5.82808823e-04],
            [1.0; 3],
        ],
    },
    everywhere("S4e", [1.0; 3]),
    Exact {
        name: "S4f",
        mean: [0.3023108, 0.30262258, 0.33339028],
        pixels: [
            [0.3194618, 0.32358929, 0.45933446],
            [0.17441897, 0.30063109, 0.51278001],
            [0.0358513, 0.02149084, 0.09551126],
        ],
    },
    Exact {
        name: "S4g",
        mean: [0.99638321, 0.96556004, 0.87739912],
        pixels: [[0.99729571, 0.94764685, 0.68783827], [0.99609844, 0.92825545, 0.67867391], [1.0; 3]],
    },
];
