//! What eight rays meet.

use crate::geometry::{Hit, NONE};
use crate::lanes::{LANES, Lane, each, in_memory};

/// The nearest shape of each of eight rays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    t: Lane,
    shape: [u32; LANES],
}

impl Nearest {
    pub(super) const NOTHING: Self = Self { t: [f32::INFINITY; LANES], shape: [NONE; LANES] };

    /// Shape `number` is met at `t`: kept where it is nearer than what was before.
    #[inline(always)]
    pub(super) fn keep(&mut self, t: &Lane, number: u32) {
        let mut nearer = [0; LANES];
        for (nearer, (t, before)) in nearer.iter_mut().zip(t.iter().zip(&self.t)) {
            *nearer = if t < before { u32::MAX } else { 0 };
        }
        in_memory(&mut nearer);
        for (shape, nearer) in self.shape.iter_mut().zip(nearer) {
            *shape = (number & nearer) | (*shape & !nearer);
        }
        self.t = each(t, &self.t, |t, before| if t < before { t } else { before });
        in_memory(self);
    }

    /// Whether no ray meets anything.
    #[inline(always)]
    pub(crate) fn is_nothing(&self) -> bool {
        self.shape.iter().all(|shape| *shape == NONE)
    }

    /// What ray number `lane` meets.
    #[inline(always)]
    pub(super) const fn lane(&self, lane: usize) -> Hit {
        Hit { t: self.t[lane], shape: self.shape[lane], triangle: NONE }
    }
}
