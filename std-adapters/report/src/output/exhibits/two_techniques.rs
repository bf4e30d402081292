//! All ways to put two auxiliaries together, in a table.

use crate::exhibits::{Combination, TwoTechniquesMse};
use crate::output::plots::{techniques, techniques_legend};

/// Draws, among those measured, at which gains are shown.
const SHOWN: usize = 1;
/// The gain of a bar of full length.
const FULL: f64 = 8.0;

/// The functions, and the errors.
pub(super) fn section(exhibit: &TwoTechniquesMse) -> String {
    let legend: String = techniques_legend().iter().map(|(swatch, name)| format!("<li>{swatch}{name}</li>")).collect();
    let plain = exhibit.estimators.first().map_or(f64::NAN, |plain| plain.measured[SHOWN].0);
    let rows = |shared: bool| -> String {
        let chosen = exhibit.estimators.iter().filter(|combination| combination.shared == shared);
        chosen.map(|combination| row(combination, plain)).collect()
    };
    let sizes: String = exhibit.draws.iter().map(|draws| format!("<th>N = {draws}</th>")).collect();
    let columns = exhibit.draws.len() + 4;
    format!(
        "<h2>Two techniques, two auxiliaries</h2>\n\
         <p>f has two peaks, each with an auxiliary of its own, and a background that neither knows; two techniques draw from \
         wider densities. One auxiliary alone harms: it promises nothing where the other peak is. Both together gain \
         several-fold, however they are put together, if the weights are learned or f is divided between them.</p>\n\
         <p>With separate draws, weights by g hand a part of f to the technique that happens to draw there, not to the \
         auxiliary that knows it; the closed-form weights do as well as the best mixture with shared draws. The table has \
         N·MSE/F² for N draws in all, ± one standard error, and what theory expects for many; the gain is plain Monte Carlo's \
         MSE over each one's at N&nbsp;=&nbsp;{shown}.</p>\n\
         <div class=\"panels functions\"><figure>{plot}<ul class=\"legend\">{legend}</ul></figure></div>\n\
         <div class=\"scroll\"><table>\n<thead><tr><th>estimator</th><th class=\"left\">gain</th>{sizes}<th>N → ∞</th>\
         <th class=\"left\">what it does</th></tr></thead>\n<tbody>\n\
         <tr><th colspan=\"{columns}\">all draws from the mixture (g₁ + g₂)/2</th></tr>\n{together}\
         <tr><th colspan=\"{columns}\">half of the draws from each technique</th></tr>\n{apart}\
         </tbody></table></div>\n",
        shown = exhibit.draws[SHOWN],
        plot = techniques(exhibit),
        together = rows(true),
        apart = rows(false),
    )
}

fn row(combination: &Combination, plain: f64) -> String {
    let measured: String = combination
        .measured
        .iter()
        .map(|(mse, error)| format!("<td>{mse:.3} <span class=\"soft\">± {error:.3}</span></td>"))
        .collect();
    let gain = plain / combination.measured[SHOWN].0;
    let width = 100.0 * (gain / FULL).min(1.0);
    format!(
        "<tr><td><code>{}</code></td><td class=\"left gain\"><i style=\"width:{width:.1}%\"></i><b>{gain:.2}</b></td>{measured}\
         <td>{:.3}</td><td class=\"left about\">{}</td></tr>\n",
        combination.estimator, combination.predicted, combination.about,
    )
}
