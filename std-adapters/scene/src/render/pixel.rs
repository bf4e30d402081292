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

/// Terms that no path has reached are alike, and one of them stands for all: a pixel of the sky has one.
#[derive(Clone, Debug)]
struct Part<C: Colour, M> {
    plain: Mean<C, 0>,
    terms: Vec<M>,
    /// Terms with moments of their own, from the first on; the others have those of the last of these.
    distinct: usize,
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
        Self { plain: Mean::default(), terms: vec![empty; terms], distinct: terms.min(1) }
    }

    /// Forgets all samples.
    fn clear(&mut self, empty: M) {
        self.plain = Mean::default();
        self.distinct = self.terms.len().min(1);
        self.terms[..self.distinct].fill(empty);
    }

    /// The moments of term number `term`, which must exist.
    fn term(&self, term: usize) -> &M {
        &self.terms[term.min(self.distinct.saturating_sub(1))]
    }

    /// Gives the first `distinct` terms moments of their own.
    fn distinguish(&mut self, distinct: usize) {
        for term in self.distinct..distinct {
            self.terms[term] = planted!("unreached_moments_forgotten": self.terms[term - 1], self.terms[0]);
            self.distinct = term + 1;
        }
    }

    /// Adds samples: plain light, and `pairs` of each term of which `distinct` are.
    fn add<'a>(&mut self, plain: &[Draw<C, 0>], distinct: usize, pairs: impl Fn(usize) -> &'a [Draw<C>]) {
        self.distinguish(distinct);
        at_best_level(Add { part: self, plain, pairs });
    }

    fn merge(&mut self, later: &Self) {
        self.plain.merge(&later.plain);
        self.distinguish(later.distinct);
        for (i, term) in self.terms[..self.distinct].iter_mut().enumerate() {
            term.merge(later.term(i));
        }
    }

    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        self.plain.words(each);
        // A file has the moments of all terms.
        self.distinguish(self.terms.len());
        for term in &mut self.terms {
            term.words(each);
        }
    }
}

/// Samples on their way into a part.
struct Add<'a, C: Colour, M, F> {
    part: &'a mut Part<C, M>,
    plain: &'a [Draw<C, 0>],
    pairs: F,
}

impl<'pairs, C: Colour, M: Term<C>, F: Fn(usize) -> &'pairs [Draw<C>]> Work for Add<'_, C, M, F> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Part { plain, terms, distinct } = self.part;
        plain.add_batch(self.plain);
        for (i, term) in terms.iter_mut().enumerate().take(*distinct) {
            term.add_batch((self.pairs)(i));
        }
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
        self.all.add(samples.plain(), samples.distinct(), |term| samples.pairs(term));
        if let Some(spread) = &mut self.spread {
            add_batch(spread, samples.plain());
        }
        // Neighbours go to different groups, so that a few samples reach all of them.
        let first = (self.all.plain.count() as usize).wrapping_sub(samples.count());
        for (g, group) in self.groups.iter_mut().enumerate() {
            let own: Vec<usize> = (0..samples.count()).filter(|i| first.wrapping_add(*i) % GROUPS == g).collect();
            let plain: Vec<_> = own.iter().map(|i| samples.plain()[*i]).collect();
            let pairs: Vec<Vec<_>> =
                (0..samples.distinct()).map(|term| own.iter().map(|i| samples.pairs(term)[*i]).collect()).collect();
            group.add(&plain, pairs.len(), |term| &pairs[term.min(pairs.len() - 1)]);
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
            part.clear(empty);
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
    fn of<C: Colour, E: OnPixel<C>>(part: &Part<C, E::Term>, estimator: &E, neighbours: &[E::Term]) -> Self {
        let plain = Plain.estimate_anyway(&part.plain, &Integrals::NONE);
        let mut total = Self { value: [0.0; 3], flags: [Flags::NONE; 3] };
        let mut add = |estimate: &Estimate<C>| {
            for channel in 0..C::LANES {
                total.value[channel] += estimate.channel(channel).value;
                total.flags[channel] |= estimate.flags(channel);
            }
        };
        add(&plain);
        // Terms that are alike saw no light. One estimate is enough, unless each learns from neighbours of its own.
        let terms = if neighbours.is_empty() { part.distinct } else { part.terms.len() };
        for i in 0..terms {
            add(&estimator.term(part.term(i), neighbours.get(i)));
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
    /// The estimate of `estimator`; coefficients are learned from `neighbours`, one per term, if there are any.
    ///
    /// The error bar is the delete-a-group jackknife of the *sum*: its terms share samples, and their variances do
    /// not add. Of plain light alone it is that of plain Monte Carlo.
    pub fn estimate<E: OnPixel<C, Term = M>>(&self, estimator: &E, neighbours: &[M]) -> PixelEstimate {
        let total = Total::of(&self.all, estimator, neighbours);
        let mut std_error = [f64::NAN; 3];
        if let Some(spread) = &self.spread {
            let plain = Plain.estimate_anyway(spread, &Integrals::NONE);
            (0..C::LANES).for_each(|channel| std_error[channel] = plain.channel(channel).std_error);
        }
        if self.groups.iter().all(|group| group.plain.count() > 0) && !self.groups.is_empty() {
            std_error = self.jackknife(estimator, neighbours);
        }
        PixelEstimate { value: total.value, std_error, flags: total.flags }
    }

    /// (G − 1)/G·Σ(θ₍₋g₎ − mean)², θ₍₋g₎ the estimate without group g.
    fn jackknife<E: OnPixel<C, Term = M>>(&self, estimator: &E, neighbours: &[M]) -> [f64; 3] {
        let without: Vec<Total> = (0..self.groups.len())
            .map(|g| {
                let mut others = self.groups.iter().enumerate().filter(|(i, _)| *i != g).map(|(_, group)| group);
                let mut rest = others.next().cloned().unwrap_or_else(|| self.all.clone());
                others.for_each(|other| rest.merge(other));
                Total::of(&rest, estimator, neighbours)
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

    /// The exponent α of each channel: the mean over the terms, by the size of their f.
    pub fn alpha<E: OnPixel<C, Term = M>>(&self, estimator: &E, neighbours: &[M]) -> [f64; 3] {
        let (mut sum, mut weights) = ([0.0; 3], [0.0; 3]);
        for i in 0..self.all.terms.len() {
            let term = self.all.term(i);
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
        let own = (0..self.all.terms.len()).map(|i| self.all.term(i));
        if terms.is_empty() {
            terms.extend(own);
        } else {
            terms.iter_mut().zip(own).for_each(|(all, own)| all.merge(own));
        }
    }
}
