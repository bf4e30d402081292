//! Draws that are made when they are asked for.

use core::fmt;
use ratiocv_core::Draw;

/// `count` draws of one channel, in `f64`; lanes of `f32` round them.
pub struct Draws<const K: usize = 1> {
    /// How many.
    pub count: usize,
    /// How often the moments of all of them are merged with themselves.
    pub doublings: u32,
    draw: Box<dyn Fn(usize) -> Draw<f64, K> + Sync>,
}

impl<const K: usize> Draws<K> {
    /// Draw i is `draw(i)`.
    ///
    /// ```
    /// use ratiocv_core::Draw;
    /// use ratiocv_stability::Draws;
    /// let ramp = Draws::new(10, |i| Draw::new(i as f64, 1.0)).doubled(3);
    /// assert_eq!((ramp.get(4).f, ramp.total()), (4.0, 80));
    /// ```
    pub fn new(count: usize, draw: impl Fn(usize) -> Draw<f64, K> + Sync + 'static) -> Self {
        Self { count, doublings: 0, draw: Box::new(draw) }
    }

    /// The same, its moments merged with themselves `times` times.
    #[must_use]
    pub fn doubled(self, times: u32) -> Self {
        Self { doublings: times, ..self }
    }

    /// Draw `i`.
    pub fn get(&self, i: usize) -> Draw<f64, K> {
        (self.draw)(i)
    }

    /// The number of draws, doublings included.
    pub fn total(&self) -> u64 {
        (self.count as u64) << self.doublings
    }
}

impl Draws {
    /// These pairs of f and h.
    pub fn listed(pairs: impl Into<Vec<(f64, f64)>>) -> Self {
        let pairs = pairs.into();
        Self::new(pairs.len(), move |i| Draw::new(pairs[i].0, pairs[i].1))
    }

    /// These f, and h = 1.
    pub fn of_f(f: impl Into<Vec<f64>>) -> Self {
        let f = f.into();
        Self::new(f.len(), move |i| Draw::new(f[i], 1.0))
    }
}

impl<const K: usize> fmt::Debug for Draws<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Draws").field("count", &self.count).field("doublings", &self.doublings).finish_non_exhaustive()
    }
}
