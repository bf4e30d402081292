//! Two folds of the draws, each with moments of its own.

use crate::moments::blocked::Blocked;
use crate::moments::groups::size;
use crate::moments::kernel::{Kernel, State, Takes, add_to_each, kernels_beside};
use crate::moments::read::HasFolds;
use crate::planted::planted;

/// The moments of `B` twice: of the even- and of the odd-numbered draws of the stream.
///
/// What is learned from one fold is independent of the other: cross-fitting. A merge deals the later
/// part's folds on from where the earlier part stopped.
///
/// ```
/// use ratiocv_core::moments::{Accumulate, ComomentsBlock, Folds, HasFolds, HasMeans, Moments};
/// use ratiocv_core::Draw;
/// let mut moments = Folds::<f64, ComomentsBlock<f64>>::default();
/// for (f, h) in [(1.0, 0.0), (5.0, 2.0), (3.0, 4.0)] {
///     moments.add(Draw::new(f, h));
/// }
/// let channel = moments.channel(0);
/// assert_eq!(channel.fold(0).means(2).f, 2.0);
/// assert_eq!(channel.fold(1).means(1).f, 5.0);
/// ```
pub type Folds<V, B> = Blocked<V, FoldsBlock<B>>;

/// The block kernel of [`Folds`].
#[derive(Clone, Copy, Debug)]
pub struct FoldsBlock<B>([B; 2]);

/// The state of [`Folds`].
#[derive(Clone, Copy, Debug, Default)]
pub struct FoldsState<S>([S; 2]);

impl<B: Kernel<State: Default>> Kernel for FoldsBlock<B> {
    type State = FoldsState<B::State>;
    // Draws go to the folds by their number, as they go to partial sums.
    const PARTIALS: usize = 1;
    const LEARNS: bool = B::LEARNS;
    kernels_beside!();

    #[inline(always)]
    fn empty(state: &Self::State) -> Self {
        Self([B::empty(&state.0[0]), B::empty(&state.0[1])])
    }
    #[inline(always)]
    fn fold(&mut self, other: &Self) {
        self.0[0].fold(&other.0[0]);
        self.0[1].fold(&other.0[1]);
    }
    #[inline(always)]
    fn close(&self, state: &Self::State, count: u64) -> Self::State {
        FoldsState(core::array::from_fn(|fold| match size(count, fold, 2) {
            // The means of no draws would be 0/0.
            0 => B::State::default(),
            count => self.0[fold].close(&state.0[fold], count),
        }))
    }
}

impl<D, B: Takes<D> + Kernel<State: Default>> Takes<D> for FoldsBlock<B> {
    #[inline(always)]
    fn begin(&mut self, index: usize, draw: &D) {
        // About a draw of the other fold, a fold of equal draws would not come out as constant.
        self.0[planted!("folds_shift": index % 2, 0)].begin(index / 2, draw);
    }
    #[inline(always)]
    fn add(&mut self, index: usize, draw: &D) {
        self.0[index % 2].add(index / 2, draw);
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, index: usize, draws: &[D; P]) {
        add_to_each(parts, index, draws);
    }
}

impl<S: State + Default> State for FoldsState<S> {
    type Channel = FoldsState<S::Channel>;

    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        let start = planted!("folds_rotation": (count % 2) as usize, 0);
        for (i, theirs) in later.0.iter().enumerate() {
            let fold = (start + i) % 2;
            let (here, there) = (size(count, fold, 2), size(later_count, i, 2));
            match (here, there) {
                (_, 0) => {}
                (0, _) => self.0[fold] = *theirs,
                _ => self.0[fold].merge(here, theirs, there),
            }
        }
    }
    fn channel(&self, channel: usize) -> Self::Channel {
        FoldsState([self.0[0].channel(channel), self.0[1].channel(channel)])
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        self.0[0].words(each);
        self.0[planted!("save_fold": 1, 0)].words(each);
    }
}

impl<S> HasFolds for FoldsState<S> {
    type Fold = S;
    fn fold(&self, fold: usize) -> &S {
        &self.0[fold]
    }
}
