//! The binary counter makes the tree that its name says.

use ratiocv_core::moments::Merge;
use ratiocv_threads::{MergeTree, merge_tree};

/// Merging is not commutative here, and remembers its order.
#[derive(Clone, Debug, PartialEq)]
struct Names(String);

impl Merge for Names {
    fn merge(&mut self, later: &Self) {
        self.0 = format!("({}{})", self.0, later.0);
    }
}

fn names(n: u64) -> Vec<Names> {
    (0..n).map(|i| Names(format!("{i};"))).collect()
}

/// Neighbours, then neighbours of those, until one is left: the definition.
fn in_rounds(mut parts: Vec<Names>) -> Option<Names> {
    while parts.len() > 1 {
        let pair = |pair: &[Names]| {
            let mut left = pair[0].clone();
            pair[1..].iter().for_each(|right| left.merge(right));
            left
        };
        parts = parts.chunks(2).map(pair).collect();
    }
    parts.pop()
}

#[test]
fn the_counter_gives_the_tree_of_rounds_for_every_number_of_parts() {
    for n in 0..=600 {
        assert_eq!(merge_tree(names(n)), in_rounds(names(n)), "{n} parts");
    }
    assert_eq!(merge_tree(names(5)).map(|all| all.0).as_deref(), Some("(((0;1;)(2;3;))4;)"));
}

#[test]
fn as_many_subtrees_are_kept_as_the_number_of_parts_has_ones() {
    let mut tree = MergeTree::default();
    for (n, name) in (0..=600_u64).zip(names(601)) {
        assert_eq!((tree.parts(), tree.subtrees().len()), (n, n.count_ones() as usize));
        tree.push(name);
    }
}
