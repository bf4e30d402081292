//! What comes of a render.

/// Linear RGB of every pixel, row by row from the top; of one channel, three equal ones.
#[derive(Clone, Debug, Default)]
pub struct Image {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Radiance; NaN where nothing was sampled.
    pub radiance: Vec<[f32; 3]>,
    /// Standard errors, NaN where unknown; empty unless asked for.
    pub std_error: Vec<[f32; 3]>,
    /// Bits of [`Flags`](ratiocv_core::Flags), all terms and channels together; empty unless asked for.
    pub flags: Vec<u32>,
    /// Exponents of a regression ratio; empty unless asked for.
    pub alpha: Vec<[f32; 3]>,
    /// Samples.
    pub samples: Vec<u64>,
}

impl Image {
    /// The mean of each channel over all pixels.
    pub fn mean(&self) -> [f64; 3] {
        let pixels = self.radiance.len() as f64;
        core::array::from_fn(|channel| {
            self.radiance.iter().map(|pixel| f64::from(pixel[channel])).sum::<f64>() / pixels
        })
    }
}
