//! One of `B` bins, in given proportions, from one random number (Walker 1977; Vose 1991).

use crate::planted::planted;
use core::array::from_fn;

/// Every bin holds a whole number of these tickets, at least one: so the probabilities are exact in
/// `f64`, sum to 1 exactly, and no bin is ever empty.
pub(super) const TICKETS: f64 = 4_294_967_296.0;

/// Whose each ticket is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Alias<const B: usize>([Slot; B]);

/// As many tickets as every other slot: the first `own` are those of the bin with the slot's number,
/// the rest those of bin `other`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Slot {
    own: u32,
    other: u32,
}

impl<const B: usize> Alias<B> {
    /// Tickets in a slot.
    const SIZE: u32 = {
        assert!(B.is_power_of_two() && 2 <= B && B <= 1 << 16, "a grid has 2, 4, 8, … or 65536 bins per dimension");
        (TICKETS as u64 / B as u64) as u32
    };

    pub(super) fn new(tickets: &[u32; B]) -> Self {
        let mut slots = from_fn(|bin| Slot { own: tickets[bin], other: bin as u32 });
        // The bins with less than a slot's tickets from the front, all others from the back.
        let (mut poor, mut rich, mut stack) = (0, B, [0; B]);
        for (bin, slot) in slots.iter().enumerate() {
            if slot.own < Self::SIZE {
                stack[poor] = bin;
                poor += 1;
            } else {
                rich -= 1;
                stack[rich] = bin;
            }
        }
        // A poor bin's slot is filled by a rich one, which may become poor by it. In whole numbers:
        // the rich last exactly as long as the poor.
        while poor > 0 {
            let (taker, giver) = (stack[poor - 1], stack[rich]);
            slots[taker].other = giver as u32;
            slots[giver].own -= Self::SIZE - slots[taker].own;
            if slots[giver].own < Self::SIZE {
                stack[poor - 1] = giver;
                rich += 1;
            } else {
                poor -= 1;
            }
        }
        Self(slots)
    }

    /// The bin that ticket number `ticket` belongs to.
    #[inline(always)]
    pub(super) fn bin(&self, ticket: u32) -> usize {
        let (bin, rest) = ((ticket / Self::SIZE) as usize % B, ticket % Self::SIZE);
        let Slot { own, other } = self.0[bin];
        // Not a branch: it would often be mispredicted.
        [planted!("alias_other": other as usize, bin) % B, bin][usize::from(rest < own)]
    }
}

/// Tickets in proportion to `weights`, which are finite, not negative, and not all 0.
pub(super) fn tickets<const B: usize>(weights: &[f64; B]) -> [u32; B] {
    let total: f64 = weights.iter().sum();
    let (mut largest, mut left) = (0, TICKETS as i64);
    let mut tickets = from_fn(|bin| {
        if weights[bin] > weights[largest] {
            largest = bin;
        }
        let share = 1 + (weights[bin] / total * (TICKETS - B as f64)) as i64;
        left -= share;
        share
    });
    // What rounding left over; or, if it took a few too many, what is missing.
    tickets[largest] += left;
    tickets.map(|share| share as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bin_gets_its_tickets_and_at_least_one() {
        assert_eq!(tickets(&[1.0, 3.0]), [1 << 30, 3 << 30]);
        assert_eq!(tickets(&[0.0, 1e-300, 0.0, 0.0]), [1, u32::MAX - 2, 1, 1]);
        assert_eq!(tickets(&[1e300; 4]), [1 << 30; 4]);
        let shares = tickets::<64>(&from_fn(|bin| 1.0 / (1.0 + bin as f64)));
        assert_eq!(shares.iter().map(|share| u64::from(*share)).sum::<u64>(), 1 << 32);
    }

    /// The numbers of tickets that the table itself hands out, slot by slot.
    fn handed_out<const B: usize>(alias: &Alias<B>) -> [u64; B] {
        let mut counts = [0; B];
        for (bin, slot) in alias.0.iter().enumerate() {
            counts[bin] += u64::from(slot.own);
            counts[slot.other as usize] += u64::from(Alias::<B>::SIZE - slot.own);
        }
        counts
    }

    #[test]
    fn the_table_hands_out_exactly_the_tickets() {
        for weights in [
            from_fn::<f64, 16, _>(|bin| bin as f64),
            from_fn(|bin| f64::from(u8::from(bin == 5))),
            from_fn(|bin| libm::exp(-(bin as f64))),
            [1.0; 16],
        ] {
            let tickets = tickets(&weights);
            assert_eq!(handed_out(&Alias::new(&tickets)), tickets.map(u64::from), "{weights:?}");
        }
    }

    #[test]
    fn a_ticket_below_own_is_the_slots_bin_and_others_are_not() {
        let alias = Alias::new(&[1 << 30, 3 << 30]);
        assert_eq!([0, (1 << 30) - 1, 1 << 30, u32::MAX].map(|ticket| alias.bin(ticket)), [0, 0, 1, 1]);
    }
}
