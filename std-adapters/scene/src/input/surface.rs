//! `<bsdf>`: what surfaces are made of.

use super::element::Element;
use super::error::Error;
use crate::planted::planted;
use crate::{Material, Roughness, Surface};
use glam::{DVec3, Vec3};

const SUPPORTED: &str = "diffuse, twosided, roughconductor, blendbsdf (of three conductors, one per channel), null";

/// A Mitsuba shape without a bsdf.
pub(super) const GREY: Surface =
    Surface { material: Material::Diffuse { reflectance: Vec3::splat(0.5) }, two_sided: false };

/// Of a `<bsdf>`.
pub(super) fn read(bsdf: Element<'_>) -> Result<Surface, Error> {
    if bsdf.kind()? != "twosided" {
        return Ok(Surface { material: material(bsdf)?, two_sided: false });
    }
    let inner = bsdf.object("bsdf")?.ok_or_else(|| bsdf.invalid("holds no <bsdf>"))?;
    bsdf.finish()?;
    match material(inner)? {
        Material::Null => Err(inner.invalid("nothing to have two sides")),
        material => Ok(Surface { material, two_sided: true }),
    }
}

fn material(bsdf: Element<'_>) -> Result<Material, Error> {
    let material = match bsdf.kind()?.as_str() {
        "diffuse" => {
            Material::Diffuse { reflectance: bsdf.color("reflectance", 1.0)?.unwrap_or(DVec3::splat(0.5)).as_vec3() }
        }
        "roughconductor" => {
            let Lobe { roughness, reflectance } = lobe(bsdf, 1.0)?;
            return Ok(Material::Conductor {
                roughness: Roughness::Grey(roughness),
                reflectance: reflectance.as_vec3(),
            });
        }
        "blendbsdf" => return chromatic_conductor(bsdf),
        "null" => Material::Null,
        "twosided" => return Err(bsdf.unsupported("a twosided within a twosided: not supported")),
        _ => return Err(bsdf.unsupported_type(SUPPORTED)),
    };
    bsdf.finish()?;
    Ok(material)
}

struct Lobe {
    roughness: f32,
    reflectance: DVec3,
}

/// A `roughconductor` whose reflectance stands for Fresnel's term.
fn lobe(bsdf: Element<'_>, most: f64) -> Result<Lobe, Error> {
    let supported = |name: &str, value: Option<String>, is_right: fn(&str) -> bool, right: &str| match value {
        Some(value) if is_right(&value) => Ok(()),
        _ => Err(bsdf.unsupported(format!("{name} must be {right}; others are not supported"))),
    };
    // Mitsuba's default is Beckmann's.
    supported("distribution", bsdf.string("distribution")?, |value| value == "ggx", "given, and be \"ggx\"")?;
    if let material @ Some(_) = bsdf.string("material")? {
        supported("material", material, |value| value == "none", "\"none\" (give specular_reflectance)")?;
    }
    if bsdf.boolean("sample_visible")? == Some(false) {
        return Err(bsdf.unsupported("sample_visible must be true; visible normals are what is sampled"));
    }
    let is_right = |alpha| (1e-4..=10.0).contains(&alpha);
    let roughness = bsdf.float("alpha", is_right, "from 0.0001 to 10")?.unwrap_or(0.1) as f32;
    let reflectance = bsdf.color("specular_reflectance", most)?.unwrap_or(DVec3::ONE);
    bsdf.finish()?;
    Ok(Lobe { roughness, reflectance })
}

/// Three conductors, each for one channel, in equal parts: the way Mitsuba can say a roughness per channel.
fn chromatic_conductor(blend: Element<'_>) -> Result<Material, Error> {
    let mut parts = Vec::new();
    for (part, weight) in halves(blend)? {
        if part.kind()? == "blendbsdf" {
            parts.extend(halves(part)?.map(|(inner, share)| (inner, weight * share)));
        } else {
            parts.push((part, weight));
        }
    }
    let needed = "a blendbsdf must be one third each of three roughconductors, such as \
                  blendbsdf (weight 2/3) of one conductor and of a blendbsdf (weight 1/2) of two";
    if parts.len() != 3 || !parts.iter().all(|(_, weight)| (weight - 1.0 / 3.0).abs() <= 1e-5) {
        return Err(blend.unsupported(needed));
    }
    let (mut roughness, mut reflectance) = (Vec3::NAN, DVec3::ZERO);
    for (part, _) in parts {
        if part.kind()? != "roughconductor" {
            return Err(part.unsupported(needed));
        }
        let lobe = lobe(part, 3.0)?;
        let channels: Vec<usize> = (0..3).filter(|&j| lobe.reflectance[j] > 0.0).collect();
        let [j] = channels[..] else {
            return Err(part.unsupported("specular_reflectance must be above 0 in one channel, and 0 in the others"));
        };
        if reflectance[j] > 0.0 {
            return Err(part.unsupported("a second conductor for the same channel"));
        }
        (roughness[j], reflectance[j]) = (lobe.roughness, lobe.reflectance[j] / planted!("lobe_third": 3.0, 1.0));
    }
    Ok(Material::Conductor { roughness: Roughness::Chromatic(roughness), reflectance: reflectance.as_vec3() })
}

/// The two parts of a blend: 1 − weight of the first, weight of the second.
fn halves<'a>(blend: Element<'a>) -> Result<[(Element<'a>, f64); 2], Error> {
    let weight = blend.float("weight", |weight| (0.0..=1.0).contains(&weight), "from 0 to 1")?;
    let weight = weight.ok_or_else(|| blend.invalid("has no <float name=\"weight\" …>"))?;
    let [first, second] = blend.objects("bsdf")?[..] else { return Err(blend.invalid("must hold two <bsdf>")) };
    blend.finish()?;
    Ok([
        (first, planted!("blend_order": 1.0 - weight, weight)),
        (second, planted!("blend_order": weight, 1.0 - weight)),
    ])
}
