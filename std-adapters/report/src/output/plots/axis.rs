//! Axes: ranges and labels.

use crate::output::words::{power_of_ten, time};
use core::ops::Range;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// What the numbers of an axis are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    /// Themselves.
    Linear,
    /// On a logarithmic axis.
    Log,
    /// Seconds on a logarithmic axis.
    LogSeconds,
}

/// A range of numbers, as they are placed on paper (logarithms are decimal), and where it is labelled.
#[derive(Clone)]
pub(super) struct Axis {
    pub(super) scale: Scale,
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) labels: Vec<f64>,
}

impl Scale {
    /// Where on the axis `x` is.
    pub(super) fn place(self, x: f64) -> f64 {
        if self == Self::Linear { x } else { libm::log10(x) }
    }
}

impl Axis {
    /// An axis on which all of `values` find place; the not finite are left out.
    pub(super) fn over(scale: Scale, values: impl Iterator<Item = f64>) -> Self {
        let places = values.map(|x| scale.place(x)).filter(|x| x.is_finite());
        let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let (low, high) = if low > high { (0.0, 1.0) } else { (low, high) };
        let least = if scale == Scale::Linear { 1e-9 } else { 0.5 };
        let (low, high) = if high - low < least { (low - least / 2.0, high + least / 2.0) } else { (low, high) };
        let margin = 0.04 * (high - low);
        let (from, to) = (low - margin, high + margin);
        let labels = if scale == Scale::Linear { even(from, to) } else { decades(from, to) };
        Self { scale, from, to, labels }
    }

    /// What stands at `place`.
    pub(super) fn label(&self, place: f64) -> String {
        if self.scale == Scale::Linear {
            return format!("{}", libm::round(place * 1e6) / 1e6 + 0.0);
        }
        let exponent = libm::floor(place + 1e-9);
        let lead = libm::round(libm::pow(10.0, place - exponent));
        match self.scale {
            Scale::LogSeconds => time(lead * libm::pow(10.0, exponent)).replace(".0 ", " "),
            _ if (-2.0..=4.0).contains(&exponent) => {
                let digits = if exponent < 0.0 { -exponent as usize } else { 0 };
                format!("{:.digits$}", lead * libm::pow(10.0, exponent))
            }
            _ if lead == 1.0 => power_of_ten(exponent as i32),
            _ => format!("{lead}·{}", power_of_ten(exponent as i32)),
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, (from, to): (i32, i32)) -> i32 {
        let share = (place - self.from) / (self.to - self.from);
        from + libm::round(share * f64::from(to - from)) as i32
    }
    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.labels.clone()
    }
    fn range(&self) -> Range<f64> {
        self.from..self.to
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, place: &f64) -> String {
        self.label(*place)
    }
}

/// Whole decades, at most seven; 1-2-5 where there are fewer than two.
fn decades(from: f64, to: f64) -> Vec<f64> {
    let whole = |step: i32| {
        let first = libm::ceil(from) as i32;
        (first..=libm::floor(to) as i32).filter(move |k| k.rem_euclid(step) == 0).map(f64::from)
    };
    if to - from < 2.0 {
        let leads = [1.0, 2.0, 5.0].map(libm::log10);
        let first = libm::floor(from) as i32;
        let all = (first..=libm::floor(to) as i32).flat_map(|k| leads.map(|lead| f64::from(k) + lead));
        return all.filter(|x| (from..=to).contains(x)).collect();
    }
    (1..).map(|step| whole(step).collect::<Vec<_>>()).find(|labels| labels.len() <= 7).unwrap_or_default()
}

/// Some four to seven round numbers.
fn even(from: f64, to: f64) -> Vec<f64> {
    let raw = (to - from) / 5.0;
    let unit = libm::pow(10.0, libm::floor(libm::log10(raw)));
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * unit).find(|step| *step >= 0.7 * raw).unwrap_or(raw);
    let first = libm::ceil(from / step) as i64;
    (first..=libm::floor(to / step) as i64).map(|k| k as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_round_and_few() {
        let axis = Axis::over(Scale::Log, [3e-9, 2.0].into_iter());
        let labels: Vec<_> = axis.labels.iter().map(|place| axis.label(*place)).collect();
        assert_eq!(labels, ["10⁻⁸", "10⁻⁶", "10⁻⁴", "0.01", "1"]);
        let axis = Axis::over(Scale::LogSeconds, [2e-7, 1.5e-6].into_iter());
        let labels: Vec<_> = axis.labels.iter().map(|place| axis.label(*place)).collect();
        assert_eq!(labels, ["200 ns", "500 ns", "1 µs"]);
        let axis = Axis::over(Scale::Linear, [0.0, 1.0].into_iter());
        assert!(axis.labels.len() >= 4 && axis.label(axis.labels[1]).len() <= 4);
    }
}
