//! One pixel: what is kept of it, and what it comes to.

use crate::colour::Colour;
use crate::path::Samples;
use crate::planted::planted;
use crate::render::method::{OnPixel, Term};
use ratiocv_core::moments::{Accumulate, Mean, Merge, Moments, Save, Variance};
use ratiocv_core::{Draw, Estimate, Estimator, Flags, Integrals, Plain};
use ratiocv_simd::{Work, add_batch, at_best_level};

/// Parts of a pixel's samples that the jackknife leaves out in turn.
const GROUPS: usize = 8;

/// What is kept of one pixel: a sum of plain light, and what the estimator reads of each depth and technique;
/// for an error bar that of each of eight groups of samples too.
#[derive(Clone, Debug)]
pub struct Pixel<C: Colour, M> {
    all: Part<C, M>,
    /// Of plain light, where that is all.
    spread: Option<Variance<C, 0>>,
    groups: Vec<Part<C, M>>,
}

#[derive(Clone, Debug)]
struct Part<C: Colour, M> {
    plain: Mean<C, 0>,
    terms: Vec<M>,
}

/// What a pixel comes to, per channel (1 or 3).
#[derive(Clone, Copy, Debug)]
pub struct PixelEstimate {
    /// Radiance.
    pub value: [f64; 3],
    /// Its standard error; NaN where unknown.
    pub std_error: [f64; 3],
    /// Remarks of all terms together.
    pub flags: [Flags; 3],
}

impl<C: Colour, M: Term<C>> Part<C, M> {
    fn new(terms: usize, empty: M) -> Self {
        Self { plain: Mean::default(), terms: vec![empty; terms] }
    }

    fn add(&mut self, plain: &[C], pairs: impl Iterator<Item = impl AsRef<[Draw<C>]>>) {
        at_best_level(AddPlain(&mut self.plain, plain));
        for (term, pairs) in self.terms.iter_mut().zip(pairs) {
            add_batch(term, pairs.as_ref());
        }
    }

    fn merge(&mut self, later: &Self) {
        self.plain.merge(&later.plain);
        for (term, later) in self.terms.iter_mut().zip(&later.terms) {
            term.merge(later);
        }
    }

    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        self.plain.words(each);
        for term in &mut self.terms {
            term.words(each);
        }
    }
}

/// Light that is added to its moments.
struct AddPlain<'a, C, M>(&'a mut M, &'a [C]);

impl<C: Colour, M: Accumulate<Draw<C, 0>>> Work for AddPlain<'_, C, M> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let mut rest = self.1.iter();
        self.0.add_from(self.1.len() as u64, || Draw { f: rest.next().copied().unwrap_or(C::ZERO), h: [] });
    }
}

impl<C: Colour, M: Term<C>> Pixel<C, M> {
    /// Nothing yet of `terms` terms; `errors`: with what an error bar needs.
    pub fn new(terms: usize, empty: M, errors: bool) -> Self {
        let groups = if errors && terms > 0 { GROUPS } else { 0 };
        Self {
            all: Part::new(terms, empty),
            spread: (errors && terms == 0).then(Variance::default),
            groups: vec![Part::new(terms, empty); groups],
        }
    }

    /// The number of samples so far.
    pub fn count(&self) -> u64 {
        self.all.plain.count()
    }

    /// Adds samples of this pixel.
    pub fn add(&mut self, samples: &Samples<C>) {
        let count = samples.count;
        self.all.add(&samples.plain[..count], samples.pairs.iter().map(|pairs| &pairs[..count]));
        if let Some(spread) = &mut self.spread {
            at_best_level(AddPlain(spread, &samples.plain[..count]));
        }
        // Neighbours go to different groups, so that a few samples reach all of them.
        let (mut plain, mut pairs) = (Vec::new(), Vec::new());
        let first = (self.all.plain.count() as usize).wrapping_sub(count);
        for (g, group) in self.groups.iter_mut().enumerate() {
            let own = |i: &usize| (first.wrapping_add(*i)) % GROUPS == g;
            plain.clear();
            plain.extend((0..count).filter(own).map(|i| samples.plain[i]));
            pairs.clear();
            pairs
                .extend(samples.pairs.iter().map(|pairs| (0..count).filter(own).map(|i| pairs[i]).collect::<Vec<_>>()));
            group.add(&plain, pairs.iter());
        }
    }

    /// Appends the samples of another image of the same scene, rendered with another seed.
    pub fn merge(&mut self, later: &Self) {
        self.all.merge(&later.all);
        if let (Some(spread), Some(later)) = (&mut self.spread, &later.spread) {
            spread.merge(later);
        }
        for (group, later) in self.groups.iter_mut().zip(&later.groups) {
            group.merge(later);
        }
    }

    /// Shows every number, for saving and loading.
    pub fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        self.all.words(each);
        if let Some(spread) = &mut self.spread {
            spread.words(each);
        }
        for group in &mut self.groups {
            group.words(each);
        }
    }

    /// Forgets all samples, so that the memory serves another pixel.
    pub fn clear(&mut self, empty: M) {
        for part in core::iter::once(&mut self.all).chain(&mut self.groups) {
            part.plain = Mean::default();
            part.terms.fill(empty);
        }
        if let Some(spread) = &mut self.spread {
            *spread = Variance::default();
        }
    }
}

/// A sum over terms.
struct Total {
    value: [f64; 3],
    flags: [Flags; 3],
}

impl Total {
    fn of<C: Colour, M>(part: &Part<C, M>, term: impl Fn(usize, &M) -> Estimate<C>) -> Self {
        let plain = Plain.estimate_anyway(&part.plain, &Integrals::NONE);
        let mut total = Self { value: [0.0; 3], flags: [Flags::NONE; 3] };
        let mut add = |estimate: &Estimate<C>| {
            for channel in 0..C::LANES {
                total.value[channel] += estimate.channel(channel).value;
                total.flags[channel] |= estimate.flags(channel);
            }
        };
        add(&plain);
        for (i, moments) in part.terms.iter().enumerate() {
            add(&term(i, moments));
        }
        // A part without light is no news, a pixel without any is; radiance is never negative.
        for channel in 0..C::LANES {
            let black = total.value[channel] == 0.0 && part.plain.count() > 0;
            let unseen = if black { Flags::NO_SUPPORT } else { Flags::NONE };
            total.flags[channel] = total.flags[channel].without(Flags::NO_SUPPORT) | unseen;
        }
        total
    }
}

impl<C: Colour, M: Term<C>> Pixel<C, M> {
    /// The estimate with `term` of each term, which is told its number.
    ///
    /// The error bar is the delete-a-group jackknife of the *sum*: its terms share samples, and their variances do
    /// not add. Of plain light alone it is that of plain Monte Carlo.
    fn estimate_with(&self, term: impl Fn(usize, &M) -> Estimate<C>) -> PixelEstimate {
        let total = Total::of(&self.all, &term);
        let mut std_error = [f64::NAN; 3];
        if let Some(spread) = &self.spread {
            let plain = Plain.estimate_anyway(spread, &Integrals::NONE);
            (0..C::LANES).for_each(|channel| std_error[channel] = plain.channel(channel).std_error);
        }
        if self.groups.iter().all(|group| group.plain.count() > 0) && !self.groups.is_empty() {
            std_error = self.jackknife(&term);
        }
        PixelEstimate { value: total.value, std_error, flags: total.flags }
    }

    /// (G − 1)/G·Σ(θ₍₋g₎ − mean)², θ₍₋g₎ the estimate without group g.
    fn jackknife(&self, term: impl Fn(usize, &M) -> Estimate<C>) -> [f64; 3] {
        let without: Vec<Total> = (0..self.groups.len())
            .map(|g| {
                let mut others = self.groups.iter().enumerate().filter(|(i, _)| *i != g).map(|(_, group)| group);
                let mut rest = others.next().cloned().unwrap_or_else(|| self.all.clone());
                others.for_each(|other| rest.merge(other));
                Total::of(&rest, &term)
            })
            .collect();
        let groups = without.len() as f64;
        core::array::from_fn(|channel| {
            if channel >= C::LANES {
                return f64::NAN;
            }
            let mean = without.iter().map(|total| total.value[channel]).sum::<f64>() / groups;
            let squares: f64 = without.iter().map(|total| (total.value[channel] - mean).powi(2)).sum();
            (planted!("jackknife_of_the_total": groups - 1.0, 1.0) / groups * squares).sqrt()
        })
    }
}

impl<C: Colour, M: Term<C>> Pixel<C, M> {
    /// The estimate of `estimator`; coefficients are learned from `neighbours`, one per term, if there are any.
    pub fn estimate<E: OnPixel<C, Term = M>>(&self, estimator: &E, neighbours: &[M]) -> PixelEstimate {
        self.estimate_with(|i, term| estimator.term(term, neighbours.get(i)))
    }

    /// The exponent α of each channel: the mean over the terms, by the size of their f.
    pub fn alpha<E: OnPixel<C, Term = M>>(&self, estimator: &E, neighbours: &[M]) -> [f64; 3] {
        let (mut sum, mut weights) = ([0.0; 3], [0.0; 3]);
        for (i, term) in self.all.terms.iter().enumerate() {
            let alpha = estimator.alpha(term, neighbours.get(i));
            let size = estimator.term(term, neighbours.get(i));
            for channel in 0..C::LANES {
                let weight = size.channel(channel).value.abs();
                if weight > 0.0 && alpha[channel].is_finite() {
                    sum[channel] += weight * alpha[channel];
                    weights[channel] += weight;
                }
            }
        }
        core::array::from_fn(|channel| sum[channel] / weights[channel])
    }

    /// Appends the terms of this pixel to `terms`, or begins with them.
    pub(super) fn merge_terms_into(&self, terms: &mut Vec<M>) {
        if terms.is_empty() {
            terms.extend_from_slice(&self.all.terms);
        } else {
            terms.iter_mut().zip(&self.all.terms).for_each(|(all, own)| all.merge(own));
        }
    }
}
