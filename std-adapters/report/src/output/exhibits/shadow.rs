//! Pictures in the shadow.

use crate::exhibits::{REACH, Shadow};
use crate::output::picture::{Picture, red_or_blue, srgb};

/// A change of the error by so much has the full colour; the floor's radiance is about 0.6.
const FULL: f64 = 0.03;
/// An error that rounding explains, of a radiance of about 1.
const EXACT: f64 = 1e-12;

/// The pictures, what each estimator made first, then what was learned.
pub(super) fn pictures(shadow: &Shadow) -> Vec<Picture> {
    let scene = |name, title: &str, pixels: &[[f64; 3]]| {
        Picture::new(name, title, shadow.width, pixels.iter().map(|rgb| rgb.map(srgb)))
    };
    let made = |index: usize, name, title: &str| scene(name, title, &shadow.estimators[index].picture);
    let alpha = |name, title: &str, alpha: &[[f64; 3]]| Picture::new(name, title, shadow.width, alpha.iter().copied());
    let improvement = |index: usize, name, title: &str| {
        let [ratio, learned] = [1, index].map(|i| shadow.estimators[i].mse.iter().map(|mse| libm::sqrt(*mse)));
        let colours = ratio.zip(learned).map(|(ratio, learned)| red_or_blue((ratio - learned) / FULL));
        Picture::new(name, title, shadow.width, colours)
    };
    vec![
        scene("shadow-reference", "What all should show", &shadow.exact),
        made(0, "shadow-plain", "Plain Monte Carlo"),
        made(1, "shadow-ratio", "Ratio"),
        made(3, "shadow-regression", "Regression ratio, α from the neighbourhood"),
        alpha("shadow-alpha", "α, learned per pixel (mean)", &shadow.alpha),
        alpha("shadow-alpha-shared", "α, learned from the neighbourhood (mean)", &shadow.shared_alpha),
        improvement(2, "shadow-improvement", "Improvement by α per pixel"),
        improvement(3, "shadow-improvement-shared", "Improvement by α from the neighbourhood"),
    ]
}

/// All of them, with a table.
pub(super) fn section(shadow: &Shadow) -> String {
    let figures: String = pictures(shadow)
        .iter()
        .map(|picture| format!("<figure>{}<figcaption>{}</figcaption></figure>\n", picture.img(), picture.title))
        .collect();
    let rows: String = shadow
        .estimators
        .iter()
        .map(|shaded| {
            let (rmse, error) = shaded.in_shadow;
            let light = if shaded.in_light <= EXACT { "exact".into() } else { format!("{:.4}", shaded.in_light) };
            format!(
                "<tr><td><code>{}</code></td><td>{rmse:.4} <span class=\"soft\">± {error:.4}</span></td>\
                 <td>{light}</td></tr>\n",
                shaded.estimator,
            )
        })
        .collect();
    let side = 2 * REACH + 1;
    format!(
        "<h2>An auxiliary that does not know of shadows</h2>\n\
         <p>A white floor under a red, a green and a blue lamp; three balls, left out of the picture, stand in the light. \
         {draws} draws per pixel; h is each draw's light as if nothing stood in the way, H is known in closed form. Where all \
         lamps are seen f = h, and the ratio is exact. In the shadow of the red lamp h goes on promising red: there the ratio \
         divides by noise that f does not have.</p>\n\
         <p>The exponent α of ȳ(H/x̄)<sup>α</sup> learns this from the draws. In the maps of α white is 1: h can be trusted; a \
         colour is missing where its lamp is. In the maps of improvement red is a smaller error than the ratio's, blue a \
         larger one, full colour a difference of {FULL} in RMSE, over {replicates} pictures. An α from the pixel's own draws \
         is noisy; that of {side} by {side} pixels is less so, but smears the edges of shadows a little.</p>\n\
         <div class=\"pictures\">\n{figures}</div>\n\
         <div class=\"scroll\"><table>\n<thead><tr><th>estimator</th><th>RMSE in shadow</th><th>RMSE in the light</th></tr>\
         </thead>\n<tbody>\n{rows}</tbody></table></div>\n",
        draws = shadow.draws,
        replicates = shadow.replicates,
    )
}
