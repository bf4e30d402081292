//! `<sensor>`: the camera, and with it the film and the sampler.

use super::element::Element;
use super::error::Error;
use super::transform::{single, uniform_scale};
use crate::planted::planted;
use crate::{Camera, Filter};
use glam::DAffine3;

/// Films of more pixels are refused.
const MOST_PIXELS: i64 = 1 << 26;

/// What is read of a sensor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sensor {
    pub(super) camera: Camera,
    pub(super) size: [u32; 2],
    pub(super) filter: Filter,
    pub(super) samples: u32,
}

/// Of `scene`.
pub(super) fn read(scene: Element<'_>) -> Result<Sensor, Error> {
    let sensor = scene.object("sensor")?;
    let sensor = sensor.ok_or_else(|| scene.invalid("has no <sensor type=\"perspective\">, so nothing sees it"))?;
    if sensor.kind()? != "perspective" {
        return Err(sensor.unsupported_type("perspective"));
    }
    let (size, filter) = film(sensor)?;
    let samples = sampler(sensor)?;
    let camera = Camera { to_world: single(&to_world(sensor)?), fov: fov(sensor, size)? as f32 };
    sensor.finish()?;
    Ok(Sensor { camera, size, filter, samples })
}

fn to_world(sensor: Element<'_>) -> Result<DAffine3, Error> {
    let to_world = sensor.transform("to_world")?.unwrap_or(DAffine3::IDENTITY);
    match uniform_scale(&to_world) {
        Some(scale) if (scale - 1.0).abs() <= 1e-3 => Ok(to_world),
        _ => Err(sensor.invalid("to_world of a camera must not scale or shear")),
    }
}

/// The angle between the left and the right edge, whichever angle was given.
fn fov(sensor: Element<'_>, size: [u32; 2]) -> Result<f64, Error> {
    let axis = sensor.string("fov_axis")?;
    let fov = sensor.float("fov", |fov| fov > 0.0 && fov < 180.0, "above 0 and below 180 degrees")?;
    let fov = fov.ok_or_else(|| sensor.unsupported("needs <float name=\"fov\" …>; focal lengths are not supported"))?;
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let half = libm::tan(fov.to_radians() / 2.0);
    let half = match axis.as_deref().unwrap_or("x") {
        "x" => return Ok(fov),
        "y" => planted!("fov_aspect": half * aspect, half / aspect),
        "smaller" if aspect > 1.0 => half * aspect,
        "larger" if aspect < 1.0 => half * aspect,
        "smaller" | "larger" => return Ok(fov),
        "diagonal" => {
            planted!("fov_diagonal": half / libm::sqrt(1.0 + 1.0 / (aspect * aspect)), half / libm::sqrt(1.0 + aspect * aspect))
        }
        other => {
            let what = format!("fov_axis \"{other}\" is unknown; known are x, y, smaller, larger, diagonal");
            return Err(sensor.invalid(what));
        }
    };
    Ok(2.0 * libm::atan(half).to_degrees())
}

fn film(sensor: Element<'_>) -> Result<([u32; 2], Filter), Error> {
    let Some(film) = sensor.object("film")? else {
        sensor.warn(
            "has no film, and with it no filter",
            "768 × 576 pixels and a box filter instead of Mitsuba's Gaussian",
        );
        return Ok(([768, 576], Filter::Box));
    };
    if film.kind()? != "hdrfilm" {
        let error = film.unsupported_type("hdrfilm");
        film.or_leave_out(Err::<(), _>(error), "read as an hdrfilm")?;
    }
    let width = film.integer("width", 1, MOST_PIXELS)?.unwrap_or(768);
    let height = film.integer("height", 1, MOST_PIXELS)?.unwrap_or(576);
    if width * height > MOST_PIXELS {
        return Err(film.invalid(format!("{width} × {height} pixels are too many; 2²⁶ is the most")));
    }
    // How an image is stored is not the scene's business here.
    for name in ["file_format", "pixel_format", "component_format"] {
        film.string(name)?;
    }
    let filter = match film.object("rfilter")? {
        Some(filter) => filter.or_leave_out(self::filter(filter), "a box filter instead")?.unwrap_or(Filter::Box),
        None => {
            film.warn("has no rfilter", "a box filter instead of Mitsuba's Gaussian");
            Filter::Box
        }
    };
    film.finish()?;
    Ok(([width as u32, height as u32], filter))
}

fn filter(filter: Element<'_>) -> Result<Filter, Error> {
    let read = match filter.kind()?.as_str() {
        "box" => Filter::Box,
        "tent" => {
            let is_right = |radius| (0.01..=100.0).contains(&radius);
            Filter::Tent { radius: filter.float("radius", is_right, "from 0.01 to 100")?.unwrap_or(1.0) as f32 }
        }
        _ => return Err(filter.unsupported_type("box, tent")),
    };
    filter.finish()?;
    Ok(read)
}

/// Samples per pixel; how their numbers are made is not the file's business here.
fn sampler(sensor: Element<'_>) -> Result<u32, Error> {
    let Some(sampler) = sensor.object("sampler")? else { return Ok(4) };
    let samples = sampler.integer("sample_count", 1, i64::from(u32::MAX))?;
    sampler.pass_over();
    Ok(samples.unwrap_or(4) as u32)
}
