//! Pictures as PNG: files, and images inside the page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::io;

/// A picture of 8-bit sRGB pixels, row by row.
pub(super) struct Picture {
    /// The file's name, without its extension.
    pub(super) name: String,
    /// What is to be seen.
    pub(super) title: String,
    width: usize,
    pixels: Vec<u8>,
}

impl Picture {
    /// Of `colours`, from 0 to 1, in rows of `width`.
    pub(super) fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        width: usize,
        colours: impl Iterator<Item = [f64; 3]>,
    ) -> Self {
        let byte = |share: f64| libm::round(255.0 * share.clamp(0.0, 1.0)) as u8;
        Self {
            name: name.into(),
            title: title.into(),
            width,
            pixels: colours.flat_map(|colour| colour.map(byte)).collect(),
        }
    }

    /// The file.
    ///
    /// # Errors
    /// Those of the encoder, which has none for a picture whose rows are full.
    pub(super) fn png(&self) -> io::Result<Vec<u8>> {
        let (width, height) = (self.width as u32, (self.pixels.len() / 3 / self.width) as u32);
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.write_header()?.write_image_data(&self.pixels)?;
        Ok(bytes)
    }

    /// An `<img>` that holds the picture itself.
    pub(super) fn img(&self) -> String {
        let Self { title, width, .. } = self;
        match self.png() {
            Ok(png) => format!(
                "<img width=\"{width}\" alt=\"{title}\" src=\"data:image/png;base64,{}\">",
                STANDARD.encode(png)
            ),
            Err(error) => format!("<p>This picture could not be drawn: {error}</p>"),
        }
    }
}

/// What a screen must be told to show the radiance `x` (IEC 61966-2-1).
pub(super) fn srgb(x: f64) -> f64 {
    if x <= 0.003_130_8 { 12.92 * x.max(0.0) } else { 1.055 * libm::pow(x, 1.0 / 2.4) - 0.055 }
}

/// Red for 1, white for 0, blue for −1.
pub(super) fn red_or_blue(x: f64) -> [f64; 3] {
    let (end, share) = if x > 0.0 { ([0.70, 0.09, 0.17], x) } else { ([0.13, 0.40, 0.67], -x) };
    end.map(|end| 1.0 + share.min(1.0) * (end - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_says_its_size_and_an_image_holds_it() {
        let picture = Picture::new("two", "two pixels", 2, [[0.0, 0.5, 1.0], [2.0, -1.0, f64::NAN]].into_iter());
        assert_eq!(picture.pixels, [0, 128, 255, 255, 0, 0]);
        let png = picture.png().unwrap();
        assert_eq!(png[..8], *b"\x89PNG\r\n\x1a\n");
        assert_eq!(png[16..24], [0, 0, 0, 2, 0, 0, 0, 1]);
        assert!(picture.img().contains("data:image/png;base64,iVBORw0KGgo"));
    }

    #[test]
    fn colours_are_those_promised() {
        assert_eq!(red_or_blue(0.0), [1.0; 3]);
        assert!(red_or_blue(0.9)[0] > red_or_blue(0.9)[2] && red_or_blue(-0.9)[2] > red_or_blue(-0.9)[0]);
        assert_eq!(red_or_blue(7.0), red_or_blue(1.0));
        assert!(libm::fabs(srgb(0.5) - 0.735_357) <= 1e-6 && libm::fabs(srgb(1.0) - 1.0) <= 1e-12);
    }
}
