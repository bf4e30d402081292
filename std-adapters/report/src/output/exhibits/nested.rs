//! Bias of a ratio inside an integral.

use crate::exhibits::NestedBias;
use crate::output::plots::{bias_of_paths, look, swatch};
use crate::output::words::short;

/// A panel for each channel.
pub(super) fn section(nested: &NestedBias) -> String {
    let legend: String = nested
        .curves
        .iter()
        .map(|curve| format!("<li>{}<code>{}</code></li>", swatch(look(curve.estimator)), curve.estimator))
        .collect();
    let panels: String = nested
        .channels
        .iter()
        .enumerate()
        .map(|(channel, name)| {
            let limit = short(100.0 * nested.limit[channel]);
            format!(
                "<figure><h3>Three bounces, {name}</h3>\n{}<figcaption>The naive ratio tends to {limit} % too \
                 much.</figcaption></figure>\n",
                bias_of_paths(nested, channel)
            )
        })
        .collect();
    format!(
        "<h2>A ratio inside an integral does not converge</h2>\n\
         <p>A path bounces three times; every channel has lobes of its own width, and all share paths that were drawn \
         from one lobe (problem <code>nested</code>). The naive way is a ratio at every bounce, from the one draw there \
         is: <code>naive_ratio</code>. However many paths it gets, its bias settles at the dotted line, its exact limit: \
         behind the first bounce each channel sees the lobe that was drawn from, not its own.</p>\n\
         <p>The ratio of whole paths, on the product of all h/H, has a bias that falls as 1/N; Hartley–Ross and Mickey on \
         the same product have none. Marks are set a little apart; bars are ±2 standard errors.</p>\n\
         <ul class=\"legend\">{legend}</ul>\n<div class=\"panels three\">\n{panels}</div>\n"
    )
}
