//! Every estimator on the same ladder of samples, one file each, in one order: empty, one draw,
//! constant, asymmetric draws with an answer worked out by hand, offset 1e9, split at every index,
//! numbers that are hardly numbers, denominators near zero.

mod fitted;
mod ladder;

mod beale;
mod choose;
mod cross_fitted;
mod deterministic_mixture;
mod difference;
mod estimated_integrals;
mod fixed;
mod hartley_ross;
mod jackknife;
mod mean_of_ratios;
mod mickey;
mod nist;
mod optimal_defensive;
mod plain;
mod quenouille;
mod random_mixture;
mod ratio_of_integrals;
mod ratio_of_means;
mod regression_ratio;
mod several;
mod tin;
mod unbiased;
