//! Image files.

use crate::render::image::Image;
use core::fmt;
use std::path::{Path, PathBuf};

/// A layer of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// Radiance.
    Radiance,
    /// Standard errors.
    Error,
    /// Bits of flags.
    Flags,
    /// Exponents.
    Alpha,
}

impl fmt::Display for Layer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Radiance => "radiance",
            Self::Error => "error",
            Self::Flags => "flags",
            Self::Alpha => "alpha",
        })
    }
}

/// Where an image went.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Written {
    /// Where it was to go.
    There(PathBuf),
    /// Somewhere else, because it could not be written where it was to go.
    Instead {
        /// The file that has it.
        path: PathBuf,
        /// What was wrong with the other one.
        because: String,
    },
}

/// Writes a layer: linear and unchanged as EXR, or in sRGB, clipped to \[0, 1\], as PNG, by the ending of `path`.
///
/// In a PNG a pixel without a value is magenta, and flags are a number of which every bit has a colour of its own. If
/// `path` cannot be written, it is tried as an EXR in the folder of temporary files.
///
/// # Errors
/// What was wrong with both files; or that the ending is neither.
pub fn write(image: &Image, layer: Layer, path: &Path) -> Result<Written, String> {
    let failed = match to(image, layer, path) {
        Ok(()) => return Ok(Written::There(path.to_owned())),
        Err(Failure::Ending) => return Err(Failure::Ending.say(path)),
        Err(failure) => failure.say(path),
    };
    let name = path.file_stem().and_then(|name| name.to_str()).unwrap_or("image");
    let other = std::env::temp_dir().join(format!("{name}-{}.exr", std::process::id()));
    match to(image, layer, &other) {
        Ok(()) => Ok(Written::Instead { path: other, because: failed }),
        Err(failure) => Err(format!("{failed}; {}", failure.say(&other))),
    }
}

enum Failure {
    Ending,
    Io(String),
}

impl Failure {
    fn say(&self, path: &Path) -> String {
        let path = path.display();
        match self {
            Self::Ending => format!("{path}: give a name that ends in .exr or .png"),
            Self::Io(error) => format!("cannot write {path}: {error}"),
        }
    }
}

fn to(image: &Image, layer: Layer, path: &Path) -> Result<(), Failure> {
    match path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("exr") => exr(image, layer, path).map_err(|error| Failure::Io(error.to_string())),
        Some("png") => png(image, layer, path).map_err(|error| Failure::Io(error.to_string())),
        _ => Err(Failure::Ending),
    }
}

/// What a layer is per pixel.
fn pixel(image: &Image, layer: Layer, index: usize) -> [f32; 3] {
    let unknown = [f32::NAN; 3];
    match layer {
        Layer::Radiance => image.radiance.get(index).copied().unwrap_or(unknown),
        Layer::Error => image.std_error.get(index).copied().unwrap_or(unknown),
        Layer::Alpha => image.alpha.get(index).copied().unwrap_or(unknown),
        Layer::Flags => image.flags.get(index).map_or(unknown, |bits| [*bits as f32; 3]),
    }
}

fn exr(image: &Image, layer: Layer, path: &Path) -> exr::error::UnitResult {
    let [width, height] = image.size.map(|size| size as usize);
    exr::prelude::write_rgb_file(path, width, height, |x, y| {
        let [r, g, b] = pixel(image, layer, y * width + x);
        (r, g, b)
    })
}

fn png(image: &Image, layer: Layer, path: &Path) -> Result<(), png::EncodingError> {
    let [width, height] = image.size;
    let mut bytes = Vec::with_capacity(3 * image.radiance.len());
    for index in 0..image.radiance.len() {
        bytes.extend(match layer {
            Layer::Flags => image.flags.get(index).map_or([255, 0, 255], |bits| colour_of(*bits)),
            _ => {
                let rgb = pixel(image, layer, index);
                if rgb.iter().all(|x| x.is_finite()) { rgb.map(srgb) } else { [255, 0, 255] }
            }
        });
    }
    let file = std::fs::File::create(path)?;
    let mut encoder = png::Encoder::new(std::io::BufWriter::new(file), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&bytes)?;
    writer.finish()
}

/// IEC 61966-2-1.
fn srgb(linear: f32) -> u8 {
    let x = linear.clamp(0.0, 1.0);
    let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded + 0.5) as u8
}

/// Black without flags; the colours of the set bits, scattered by a hash and mixed, otherwise.
fn colour_of(bits: u32) -> [u8; 3] {
    if bits == 0 {
        return [0; 3];
    }
    let hash = bits.wrapping_mul(0x9e37_79b9);
    [24, 16, 8].map(|shift| 64 + ((hash >> shift) as u8) / 2)
}
