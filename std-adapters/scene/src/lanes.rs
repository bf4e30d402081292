//! Eight numbers or vectors side by side.
//!
//! Plain loops over arrays, which the compiler turns into vector instructions of whatever level the caller is
//! compiled for. Two habits make it do so: what a loop chooses between is read first, and what comes of it is
//! [`in_memory`].

use glam::Vec3;

/// Lanes.
pub(crate) const LANES: usize = 8;

/// A number of each.
pub(crate) type Lane = [f32; LANES];

/// The number of each, as wide as a lane.
pub(crate) const NUMBERS: [u32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7];

/// Lanes that are seen from outside here: of numbers that need not be anywhere the compiler makes scalars.
#[inline(always)]
pub(crate) fn in_memory<T>(lanes: &mut T) {
    core::hint::black_box(lanes);
}

/// `of` each pair.
#[inline(always)]
pub(crate) fn each(a: &Lane, b: &Lane, of: impl Fn(f32, f32) -> f32) -> Lane {
    let (a, b) = (*a, *b);
    let mut lanes = [0.0; LANES];
    for lane in 0..LANES {
        lanes[lane] = of(a[lane], b[lane]);
    }
    lanes
}

/// All bits set where something holds.
pub(crate) type Mask = [u32; LANES];

/// Where `holds` of each pair.
#[inline(always)]
pub(crate) fn mask<A: Copy, B: Copy>(a: &[A; LANES], b: &[B; LANES], holds: impl Fn(A, B) -> bool) -> Mask {
    let (a, b) = (*a, *b);
    let mut mask = [0; LANES];
    for lane in 0..LANES {
        mask[lane] = if holds(a[lane], b[lane]) { u32::MAX } else { 0 };
    }
    in_memory(&mut mask);
    mask
}

/// `a` where `mask` is set, `b` elsewhere.
#[inline(always)]
pub(crate) fn blend(mask: &Mask, a: &Lane, b: &Lane) -> Lane {
    let (mask, a, b) = (*mask, *a, *b);
    let mut lanes = [0.0; LANES];
    for lane in 0..LANES {
        lanes[lane] = f32::from_bits((a[lane].to_bits() & mask[lane]) | (b[lane].to_bits() & !mask[lane]));
    }
    lanes
}

/// The sum, in a tree.
#[inline(always)]
pub(crate) fn total([a, b, c, d, e, f, g, h]: Lane) -> f32 {
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// The least, in a tree.
#[inline(always)]
pub(crate) fn least<T: Copy + PartialOrd>([a, b, c, d, e, f, g, h]: [T; LANES]) -> T {
    let less = |a, b| if a < b { a } else { b };
    less(less(less(a, e), less(c, g)), less(less(b, f), less(d, h)))
}

/// The first lane that is `value`, which must be there.
#[inline(always)]
pub(crate) fn first_lane(lanes: &Lane, value: f32) -> u32 {
    let mut numbers = [0; LANES];
    for lane in 0..LANES {
        numbers[lane] = if lanes[lane] == value { NUMBERS[lane] } else { LANES as u32 };
    }
    least(numbers)
}

/// Vectors side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vectors {
    pub(crate) x: Lane,
    pub(crate) y: Lane,
    pub(crate) z: Lane,
}

impl Vectors {
    pub(crate) const ZERO: Self = Self { x: [0.0; LANES], y: [0.0; LANES], z: [0.0; LANES] };

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: Vec3) {
        (self.x[lane], self.y[lane], self.z[lane]) = (v.x, v.y, v.z);
    }

    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_least_by_hand() {
        let lanes = [3.0, -1.0, 4.0, 2.5, -1.0, 9.0, 0.5, 7.0];
        assert_eq!((total(lanes), least(lanes), first_lane(&lanes, least(lanes))), (24.0, -1.0, 1));
        assert_eq!(first_lane(&lanes, 7.0), 7);
        let difference = each(&lanes, &[1.0; LANES], |a, b| a - b);
        assert_eq!(difference, [2.0, -2.0, 3.0, 1.5, -2.0, 8.0, -0.5, 6.0]);
    }
}
