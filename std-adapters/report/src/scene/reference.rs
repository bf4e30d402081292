//! What is taken for the truth.

use crate::scene::{SceneFault, SceneSettings};
use ratiocv_scene::{Budget, Description, Image, Method, Render};
use ratiocv_threads::CheckpointFile;
use std::path::Path;

/// Of no image that is compared with it.
const SEED: u64 = 0x5eed;

/// A long render by the defensive ratio, and how far it may be off.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Linear RGB.
    pub radiance: Vec<[f32; 3]>,
    /// Samples per pixel.
    pub samples: u64,
    /// Mean over pixels and channels of its own squared standard error: what is subtracted from errors measured
    /// against it.
    pub mse: f64,
}

impl Reference {
    /// Rendered, or read from a file in `folder` that an earlier report left there.
    pub(super) fn of(
        description: &Description,
        settings: &SceneSettings,
        samples: u64,
        folder: &Path,
    ) -> Result<Self, SceneFault> {
        let file = CheckpointFile::new(
            folder.join(format!("reference-{:08x}.ratiocv", fingerprint(description, settings))),
            [("the version of ratiocv", env!("CARGO_PKG_VERSION").to_owned()), ("samples", samples.to_string())]
                .map(|(name, value)| (name.to_owned(), value))
                .to_vec(),
        );
        // One that does not fit is made anew.
        if let Ok(Some(words)) = file.load()
            && let Some(reference) = Self::from_words(&words, samples, description.size)
        {
            return Ok(reference);
        }
        let rendered = Render::new(description)
            .options(settings.options)
            .method(Method::default())
            .budget(Budget::Samples(samples))
            .seed(SEED)
            .errors(true)
            .run()?;
        let reference = Self::from_image(&rendered.image, samples);
        file.save(&reference.words()).map_err(SceneFault::Reference)?;
        Ok(reference)
    }

    fn from_image(image: &Image, samples: u64) -> Self {
        let (mut sum, mut count) = (0.0, 0.0);
        for error in image.std_error.iter().flatten() {
            // A pixel that never saw light has none, and cannot be told from a black one.
            if error.is_finite() {
                sum += f64::from(*error) * f64::from(*error);
            }
            count += 1.0;
        }
        Self { radiance: image.radiance.clone(), samples, mse: sum / count }
    }

    fn words(&self) -> Vec<u64> {
        let radiances = self.radiance.iter().flatten().map(|x| u64::from(x.to_bits()));
        [self.mse.to_bits()].into_iter().chain(radiances).collect()
    }

    fn from_words(words: &[u64], samples: u64, size: [u32; 2]) -> Option<Self> {
        let (mse, radiances) = words.split_first()?;
        let (pixels, none) = radiances.as_chunks::<3>();
        if !none.is_empty() || pixels.len() as u64 != u64::from(size[0]) * u64::from(size[1]) {
            return None;
        }
        let radiance = pixels.iter().map(|pixel| pixel.map(|word| f32::from_bits(word as u32))).collect();
        Some(Self { radiance, samples, mse: f64::from_bits(*mse) })
    }

    /// Mean over pixels and channels of the squared error of `image`, and of the same relative to the reference, its
    /// own error subtracted from the first.
    pub(super) fn compare(&self, image: &Image) -> (f64, f64) {
        let (mut square, mut relative, mut count) = (0.0, 0.0, 0.0);
        for (pixel, right) in image.radiance.iter().zip(&self.radiance) {
            for (x, right) in pixel.iter().zip(right) {
                let error = f64::from(*x) - f64::from(*right);
                square += error * error;
                relative += error * error / (f64::from(*right) * f64::from(*right) + 0.01);
                count += 1.0;
            }
        }
        (square / count - self.mse, relative / count)
    }
}

/// Tells scenes and ways to choose lights apart; how many samples the scene asks for is none of it.
fn fingerprint(description: &Description, settings: &SceneSettings) -> u32 {
    let unlimited = Description { samples: 0, ..description.clone() };
    crc32fast::hash(format!("{unlimited:?} {:?}", settings.options).as_bytes())
}
