//! A case, run.

use crate::answer::{EXACT, digits_of};
use crate::case::{Ask, Case, Naive, Precision};
use crate::lane_types::{Call, Channels, Kept, Parts, middle};
use crate::method::regressed;
use crate::naive::naive;
use ratiocv_core::ChannelEstimate;

/// With more draws than this, a scalar takes them in a batch and in a tree, and an array draw by draw.
const MANY: u64 = 100_000;
/// With more than this, a scalar alone.
const VERY_MANY: u64 = 2_000_000;

/// Who answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contender {
    /// This library.
    Ours,
    /// The textbook formula in our place: what a table of failures looks like.
    Naive,
}

/// What came out of a case.
#[derive(Clone, Debug)]
pub struct Row {
    /// The case.
    pub id: &'static str,
    /// Its section.
    pub section: &'static str,
    /// What is hard about it.
    pub about: &'static str,
    /// The precision of its draws.
    pub precision: Precision,
    /// What was asked.
    pub asked: String,
    /// The right value.
    pub right: f64,
    /// Digits needed.
    pub needed: f64,
    /// The estimate of the lanes and the way of accumulating that have the fewest digits.
    pub ours: ChannelEstimate,
    /// Their digits.
    pub digits: f64,
    /// The textbook's value, if there is a formula.
    pub naive: Option<f64>,
    /// Its digits.
    pub naive_digits: Option<f64>,
    /// How many combinations of lanes, ways of accumulating and orders of merging were run.
    pub runs: usize,
    /// What is broken, and where; `None` if nothing is.
    pub broken: Option<String>,
}

/// Digits, the estimate, and what is broken, of one run.
struct Run {
    digits: f64,
    ours: ChannelEstimate,
    broken: Option<String>,
}

impl Row {
    /// Runs `case`.
    pub fn of(case: &Case, contender: Contender) -> Self {
        let value = match case.naive {
            Naive::Formula => Some(naive(&case.ask, case.precision)),
            Naive::By(by) => Some(by()),
            Naive::None => None,
        };
        let runs = match (contender, value) {
            (Contender::Naive, Some(value)) => {
                vec![judged(case, crate::method::number(value, ratiocv_core::Flags::NONE), None, "textbook", "")]
            }
            _ => all_runs(case),
        };
        let worst = runs.iter().min_by(|a, b| a.digits.total_cmp(&b.digits));
        let (digits, ours) = worst
            .map_or((f64::NAN, crate::method::number(f64::NAN, ratiocv_core::Flags::NONE)), |run| {
                (run.digits, run.ours)
            });
        Self {
            id: case.id,
            section: case.section(),
            about: case.about,
            precision: case.precision,
            asked: match &case.ask {
                Ask::One { method, .. } => method.name(),
                Ask::Two { method, .. } => format!("{method:?} of two"),
                Ask::Five { which: 5, .. } => "intercept".into(),
                Ask::Five { which, .. } => format!("coefficient {}", which + 1),
                Ask::Probe(_) => "probe".into(),
            },
            right: case.right.value,
            needed: case.right.digits,
            ours,
            digits,
            naive: value,
            naive_digits: value.map(|value| digits_of(value, case.right.value)),
            runs: runs.len(),
            broken: runs.into_iter().find_map(|run| run.broken),
        }
    }

    /// Whether all is as it must be.
    pub fn passes(&self) -> bool {
        self.broken.is_none()
    }

    /// Whether a flag stands in for digits that are not there.
    pub fn excused(&self) -> bool {
        self.passes() && self.digits < self.needed
    }
}

/// "17" is every bit.
pub(crate) fn shown_digits(digits: f64) -> String {
    if digits >= EXACT {
        "exact".into()
    } else if digits < 0.0 || digits.is_nan() {
        "none".into()
    } else {
        format!("{digits:.1}")
    }
}

fn judged(case: &Case, ours: ChannelEstimate, unlawful: Option<String>, lanes: &str, how: &str) -> Run {
    let digits = digits_of(ours.value, case.right.value);
    let broken = unlawful.or_else(|| case.right.judge(ours).err());
    Run { digits, ours, broken: broken.map(|broken| format!("{lanes} {how}: {broken}")) }
}

fn all_runs(case: &Case) -> Vec<Run> {
    let epsilon = case.precision.of(f64::from(f32::EPSILON), f64::EPSILON);
    match &case.ask {
        Ask::One { method, draws, then, integral } => {
            let parts: Vec<_> = [Some(draws), then.as_ref()].into_iter().flatten().collect();
            on_lanes(case, &parts, |moments, count, own| {
                method.estimate(moments, count, epsilon, if own { *integral } else { 1.0 })
            })
        }
        Ask::Two { method, draws, integrals } => on_lanes(case, &[draws], |moments, count, own| {
            method.estimate(moments, count, epsilon, if own { integrals } else { &[1.0; 2] })
        }),
        Ask::Five { which, draws } => {
            on_lanes(case, &[draws], |moments, count, _| regressed(moments, count, epsilon, *which))
        }
        Ask::Probe(probes) => probes.run().map(|(lanes, ours)| judged(case, ours, None, lanes, "")).collect(),
    }
}

/// Runs `estimate` of the moments of `parts` on every lane type: the case itself in the middle channel.
fn on_lanes<S: Kept<K>, const K: usize>(
    case: &Case,
    parts: &[&crate::Draws<K>],
    estimate: impl Fn(&S, u64, bool) -> ChannelEstimate,
) -> Vec<Run> {
    let count = parts.iter().map(|draws| draws.count as u64).sum::<u64>();
    let is_run = |lanes: usize, call| match lanes {
        _ if count <= MANY => true,
        1 => call != Call::Singly,
        3 => call == Call::Singly && count <= VERY_MANY,
        _ => false,
    };
    let orders: Vec<Vec<_>> = match parts {
        [first, second] => vec![vec![*first, *second], vec![*second, *first]],
        _ => vec![parts.to_vec()],
    };
    let mut runs = Vec::new();
    for lanes in S::lane_types(case.precision) {
        for call in Call::ALL.into_iter().filter(|call| is_run(lanes.lanes, *call)) {
            for parts in &orders {
                let own = (lanes.moments)(&Parts { parts: parts.clone(), innocent: false }, call);
                let ours = estimate(&own.channels[middle(lanes.lanes)], own.count, true);
                // Where nothing is beside it there is no law.
                let unlawful = if lanes.lanes == 1 {
                    None
                } else {
                    let alone = (lanes.moments)(&Parts { parts: parts.clone(), innocent: true }, call);
                    touched(&own, &alone, &estimate)
                };
                runs.push(judged(case, ours, unlawful, lanes.name, call.name()));
            }
        }
    }
    runs
}

/// Which innocent channel has other bits beside the case than beside another innocent.
fn touched<S>(
    own: &Channels<S>,
    alone: &Channels<S>,
    estimate: impl Fn(&S, u64, bool) -> ChannelEstimate,
) -> Option<String> {
    let lanes = own.channels.len();
    let bits = |moments: &Channels<S>, lane: usize| {
        let ChannelEstimate { value, std_error, flags } = estimate(&moments.channels[lane], moments.count, false);
        (value.to_bits(), std_error.to_bits(), flags)
    };
    let innocent = (0..lanes).filter(|lane| *lane != middle(lanes));
    innocent
        .into_iter()
        .find(|lane| bits(own, *lane) != bits(alone, *lane))
        .map(|lane| format!("the case changed the bits of channel {lane}"))
}
