//! The tree in which results meet.

use ratiocv_core::moments::Merge;

/// Parts that arrive in order, merged in a fixed binary tree: neighbours, then neighbours of those, an
/// odd one out being handed up.
///
/// A binary counter: part n is merged with as many complete subtrees as n has trailing ones. So N
/// parts are kept as one subtree for each 1 in the binary form of N, never more than 64, and the
/// shape is a function of N alone.
///
/// ```
/// use ratiocv_core::moments::Merge;
/// use ratiocv_threads::MergeTree;
/// struct Name(String);
/// impl Merge for Name {
///     fn merge(&mut self, later: &Self) {
///         self.0 = format!("({}{})", self.0, later.0);
///     }
/// }
/// let mut tree = MergeTree::default();
/// for name in ["a", "b", "c", "d", "e", "f", "g"] {
///     tree.push(Name(name.into()));
/// }
/// assert_eq!(tree.subtrees().len(), 3); // 7 = 4 + 2 + 1
/// assert_eq!(tree.merged().map(|all| all.0).as_deref(), Some("(((ab)(cd))((ef)g))"));
/// ```
#[derive(Clone, Debug)]
pub struct MergeTree<M> {
    parts: u64,
    /// The largest, and earliest, first.
    subtrees: Vec<M>,
}

impl<M> Default for MergeTree<M> {
    fn default() -> Self {
        Self { parts: 0, subtrees: Vec::new() }
    }
}

impl<M> MergeTree<M> {
    /// The number of parts so far.
    pub fn parts(&self) -> u64 {
        self.parts
    }

    /// The complete subtrees, the largest and earliest first: of 2ⁱ parts for each bit i of
    /// [`parts`](Self::parts) that is set.
    pub fn subtrees(&self) -> &[M] {
        &self.subtrees
    }

    /// The tree of `parts` parts with these subtrees; `None` if there are not as many as `parts` has bits set.
    pub(crate) fn from_subtrees(parts: u64, subtrees: Vec<M>) -> Option<Self> {
        (subtrees.len() == parts.count_ones() as usize).then_some(Self { parts, subtrees })
    }
}

impl<M: Merge> MergeTree<M> {
    /// Appends the next part.
    pub fn push(&mut self, part: M) {
        let mut later = part;
        for _ in 0..self.parts.trailing_ones() {
            if let Some(mut earlier) = self.subtrees.pop() {
                earlier.merge(&later);
                later = earlier;
            }
        }
        self.subtrees.push(later);
        self.parts += 1;
    }

    /// All parts as one; `None` of nothing.
    pub fn merged(self) -> Option<M> {
        self.subtrees.into_iter().rev().reduce(|later, mut earlier| {
            earlier.merge(&later);
            earlier
        })
    }
}

/// `parts` merged as by [`MergeTree`]; `None` of nothing.
pub fn merge_tree<M: Merge>(parts: Vec<M>) -> Option<M> {
    let mut tree = MergeTree::default();
    for part in parts {
        tree.push(part);
    }
    tree.merged()
}
