//! Accumulators: the moments of the draws that an estimator reads, and nothing else.
//!
//! Draws are summed in blocks of 64 about a shift, in the precision of their lanes, and the blocks
//! are merged pairwise into `f64` state that keeps an anchor and means relative to it. An
//! accumulator is a [`Kernel`] in a [`Blocked`] stream; [`Joined`] puts several kernels into one
//! pass.
//!
//! What each estimator keeps, in bytes per pixel of `Spectrum<f32, 3>` and per `f64` channel:
//!
#![doc = include_str!("sizes.md")]

mod accumulate;
mod blocked;
mod checked;
mod comoments;
mod extremes;
mod folds;
mod groups;
mod joined;
mod kernel;
mod pairs;
mod range;
mod read;
mod run;
mod save;
mod slices;
mod sums;
mod third;
mod univariate;

pub use accumulate::{Accumulate, AccumulateSlices, Merge, Moments, Widened};
pub use blocked::Blocked;
pub use checked::{Checked, Finite, Refuse, Skip};
pub use comoments::{Comoments, ComomentsBlock, ComomentsState};
pub use extremes::{Extremes, ExtremesBlock, ExtremesState, MayHaveTails};
pub use folds::{Folds, FoldsBlock, FoldsState};
pub use groups::{Groups, GroupsBlock, GroupsState};
pub use joined::Joined;
pub use kernel::{Kernel, State, Takes};
pub use pairs::{GroupedPairs, Pairs, PairsBlock, PairsState};
pub use read::{
    Group, HasComoments, HasFolds, HasGroups, HasMeans, HasPairs, HasRatioMean, HasThirdMoments, Means, RatioMoments,
    Spread, Tails, ThirdMoments,
};
pub use run::BLOCK;
pub use save::Save;
pub use slices::Slices;
pub use sums::{Sums, SumsBlock, SumsState};
pub use third::{Third, ThirdBlock, ThirdState};
pub use univariate::{
    IntegrandOf, Mean, Quantity, RatioMean, RatioOf, RatioVariance, UnivariateBlock, UnivariateState, Variance,
};
