//! Every estimator on the same ladder of samples, one file each, in one order: empty, one draw,
//! constant, asymmetric draws with an answer worked out by hand, offset 1e9, split at every index,
//! numbers that are hardly numbers, denominators near zero.

mod ladder;

mod beale;
mod hartley_ross;
mod mean_of_ratios;
mod mickey;
mod plain;
mod quenouille;
mod ratio_of_means;
mod tin;
