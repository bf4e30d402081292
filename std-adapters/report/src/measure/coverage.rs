//! Whether intervals contain what they should.

use ratiocv_core::ChannelEstimate;

/// The numbers of draws after which intervals are judged.
const JUDGED: [u64; 3] = [16, 64, 256];
/// Standard errors to either side of a value: 95 % of a normal distribution.
const QUANTILE: f64 = 1.96;
/// An error, relative to F, that rounding explains: no error bar is to account for it.
const ROUNDING: f64 = 1e-12;

/// Whether intervals are judged after so many draws.
pub(super) fn is_judged(draws: u64) -> bool {
    JUDGED.contains(&draws)
}

/// How often the interval value ± 1.96 std_error contains F, allowing for rounding of 10⁻¹² F.
///
/// All shares are of estimates of one channel, or of all channels together. A share of nothing is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coverage {
    /// Share of the intervals that contain F: 0.95 where error bars mean what they say.
    pub share: f64,
    /// Its standard error: that of a ratio of means over replicates (Cochran 1977), since the channels of
    /// a replicate share its draws; where all replicates agree, what one more that does not would add.
    pub std_error: f64,
    /// Share of the estimates that have no interval, their error being unknown: neither hits nor misses.
    pub without: f64,
    /// Share of the estimates with any flag.
    pub flagged: f64,
    /// Share of the intervals that miss F with any flag.
    pub missed_flagged: f64,
}

impl Coverage {
    /// Whether fewer than 90 % of the intervals contain F, or fewer than 90 % of the estimates have one.
    pub fn is_poor(&self) -> bool {
        // No interval at all is poor: NaN must not pass.
        !(self.share >= 0.9 && self.without <= 0.1)
    }
}

/// Counts over the channels of one replicate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    estimates: u64,
    intervals: u64,
    hits: u64,
    flagged: u64,
    missed_flagged: u64,
}

impl Counts {
    /// One estimate of `exact`.
    pub(super) fn of(estimate: ChannelEstimate, exact: f64) -> Self {
        let ChannelEstimate { value, std_error, flags } = estimate;
        let interval = std_error.is_finite();
        let hit = interval && libm::fabs(value - exact) <= QUANTILE * std_error + ROUNDING * libm::fabs(exact);
        let flagged = !flags.is_empty();
        Self {
            estimates: 1,
            intervals: u64::from(interval),
            hits: u64::from(hit),
            flagged: u64::from(flagged),
            missed_flagged: u64::from(interval && !hit && flagged),
        }
    }

    pub(super) fn append(&mut self, other: &Self) {
        self.estimates += other.estimates;
        self.intervals += other.intervals;
        self.hits += other.hits;
        self.flagged += other.flagged;
        self.missed_flagged += other.missed_flagged;
    }
}

/// Sums over replicates, exact: of counts, and of the products that the error of a share needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Hits {
    replicates: u64,
    counts: Counts,
    hits_hits: u64,
    hits_intervals: u64,
    intervals_intervals: u64,
}

impl Hits {
    /// One replicate.
    pub(super) fn add(&mut self, counts: Counts) {
        self.replicates += 1;
        self.counts.append(&counts);
        self.hits_hits += counts.hits * counts.hits;
        self.hits_intervals += counts.hits * counts.intervals;
        self.intervals_intervals += counts.intervals * counts.intervals;
    }

    pub(super) fn append(&mut self, other: &Self) {
        self.replicates += other.replicates;
        self.counts.append(&other.counts);
        self.hits_hits += other.hits_hits;
        self.hits_intervals += other.hits_intervals;
        self.intervals_intervals += other.intervals_intervals;
    }

    /// The shares; `None` if there was no replicate.
    pub(super) fn coverage(&self) -> Option<Coverage> {
        let Counts { estimates, intervals, hits, flagged, missed_flagged } = self.counts;
        let of = |part: u64, whole: u64| part as f64 / whole as f64;
        let share = of(hits, intervals);
        // Σ(hits − share·intervals)² over replicates.
        let residual = self.hits_hits as f64 - 2.0 * share * self.hits_intervals as f64
            + share * share * self.intervals_intervals as f64;
        let std_error = libm::sqrt(residual.max(0.0)) / intervals as f64;
        let least = of(1, self.replicates);
        (self.replicates > 0).then(|| Coverage {
            share,
            std_error: if share.is_nan() { share } else { std_error.max(least) },
            without: of(estimates - intervals, estimates),
            flagged: of(flagged, estimates),
            missed_flagged: of(missed_flagged, intervals - hits),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratiocv_core::Flags;

    fn counts(value: f64, std_error: f64, flags: Flags) -> Counts {
        Counts::of(ChannelEstimate { value, std_error, flags }, -10.0)
    }

    /// Whether an interval hits; `None` if it is none.
    fn hit(value: f64, std_error: f64) -> Option<bool> {
        let counts = counts(value, std_error, Flags::NONE);
        (counts.intervals == 1).then_some(counts.hits == 1)
    }

    #[test]
    fn an_interval_is_1_96_standard_errors_to_either_side() {
        assert_eq!([hit(-11.95, 1.0), hit(-11.97, 1.0)], [Some(true), Some(false)]);
        assert_eq!([hit(-8.05, 1.0), hit(-8.03, 1.0)], [Some(true), Some(false)]);
    }

    #[test]
    fn rounding_is_allowed_where_the_error_bar_is_zero() {
        assert_eq!([hit(-10.0, 0.0), hit(-10.0 - 5e-12, 0.0)], [Some(true); 2]);
        assert_eq!(hit(-10.0 - 2e-11, 0.0), Some(false));
    }

    #[test]
    fn an_unknown_error_is_no_interval_and_an_unknown_value_a_miss() {
        assert_eq!([hit(-10.0, f64::NAN), hit(f64::NAN, f64::NAN), hit(-10.0, f64::INFINITY)], [None; 3]);
        assert_eq!(hit(f64::NAN, 1.0), Some(false));
    }

    /// `estimates` of one channel, one a replicate.
    fn of_channel(estimates: &[(f64, f64, Flags)]) -> Coverage {
        let mut hits = Hits::default();
        for (value, std_error, flags) in estimates {
            hits.add(counts(*value, *std_error, *flags));
        }
        hits.coverage().unwrap()
    }

    #[test]
    fn shares_are_of_intervals_estimates_and_misses() {
        let (none, low) = (Flags::NONE, Flags::LOW_ESS);
        let hit = (-10.0, 1.0, none);
        let coverage = of_channel(&[hit, hit, hit, (-13.0, 1.0, low), (-10.0, f64::NAN, Flags::NO_SUPPORT)]);
        assert_eq!((coverage.share, coverage.without, coverage.flagged), (0.75, 0.2, 0.4));
        assert_eq!(coverage.missed_flagged, 1.0);
        // √(p(1 − p)/n) of four intervals.
        assert!((coverage.std_error - libm::sqrt(0.75 * 0.25 / 4.0)).abs() <= 1e-15);
        assert!(coverage.is_poor() && !of_channel(&[hit]).is_poor());
        assert!(of_channel(&[hit, (-10.0, f64::NAN, none)]).is_poor());
        let missed = of_channel(&[(-13.0, 1.0, low), (-7.0, 1.0, none), (-6.0, 1.0, none), hit]);
        assert!((missed.missed_flagged - 1.0 / 3.0).abs() <= 1e-15);
    }

    #[test]
    fn without_intervals_nothing_is_known() {
        let coverage = of_channel(&[(-10.0, f64::NAN, Flags::NONE); 3]);
        assert_eq!((coverage.without, coverage.flagged), (1.0, 0.0));
        assert!(coverage.share.is_nan() && coverage.std_error.is_nan() && coverage.missed_flagged.is_nan());
        assert!(coverage.is_poor());
        assert_eq!(Hits::default().coverage(), None);
    }

    #[test]
    fn channels_of_a_replicate_are_not_independent() {
        let replicate = |first: f64, second: f64| {
            let mut both = counts(first, 1.0, Flags::NONE);
            both.append(&counts(second, 1.0, Flags::NONE));
            both
        };
        let (mut together, mut apart) = (Hits::default(), Hits::default());
        for _ in 0..8 {
            together.add(replicate(-10.0, -10.0));
            together.add(replicate(-20.0, -20.0));
            apart.add(replicate(-10.0, -20.0));
            apart.add(replicate(-20.0, -10.0));
        }
        let (together, apart) = (together.coverage().unwrap(), apart.coverage().unwrap());
        assert_eq!((together.share, apart.share), (0.5, 0.5));
        // Sixteen replicates that hit or miss as one: √(p(1 − p)/16). Those that always hit once: no spread.
        assert_eq!((together.std_error, apart.std_error), (0.125, 1.0 / 16.0));
    }

    #[test]
    fn parts_append_to_the_whole() {
        let (mut whole, mut left, mut right) = (Hits::default(), Hits::default(), Hits::default());
        for (part, value) in [(0, -10.0), (0, -20.0), (1, -20.0)] {
            let mut counts = counts(value, 1.0, Flags::LOW_ESS);
            counts.append(&self::counts(-10.0, f64::NAN, Flags::NONE));
            whole.add(counts);
            if part == 0 { &mut left } else { &mut right }.add(counts);
        }
        left.append(&right);
        assert_eq!(left, whole);
        assert_eq!(whole.coverage().unwrap().share, 1.0 / 3.0);
    }
}
