//! `scene.html`: one file, nothing loaded from elsewhere.

use crate::output::page::{STYLE, escaped};
use crate::output::plots::{drawn, look, scene_error, swatch};
use crate::output::scene::images::pictures;
use crate::scene::SceneReport;
use core::fmt::Write;

/// Gains below this are no gains worth the name.
const PLAIN: f64 = 1.05;

pub(super) fn page(report: &SceneReport) -> String {
    let name = escaped(&report.name);
    // Writing to a String cannot fail.
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{name}: error against run time</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <h1>{name}: error against run time</h1>\n"
    );
    verdict(&mut page, report);
    images(&mut page, report);
    let entries: String = drawn(report)
        .map(|curve| format!("<li>{}<code>{}</code></li>", swatch(look(curve.method.name())), curve.method.name()))
        .collect();
    let _ = write!(
        page,
        "<h2>Error against run time</h2>\n<p>Left and low is good; black dashes are plain Monte Carlo. Run times are of \
         the whole image, on all cores. Each mark has four times the samples of the one before. Of methods that come with and without the defensive auxiliary, the one with it is drawn.</p>\n\
         <ul class=\"legend\">{entries}</ul>\n<div class=\"panels\"><figure>{}</figure></div>\n",
        scene_error(report)
    );
    tables(&mut page, report);
    foot(&mut page, report);
    page
}

fn verdict(page: &mut String, report: &SceneReport) {
    let last = |curve: &crate::scene::Curve| curve.points.iter().rfind(|point| point.samples <= 64).copied();
    let best = report.curves.iter().filter_map(|curve| last(curve).map(|point| (curve.method, point)));
    if let Some((method, point)) = best.max_by(|a, b| a.1.efficiency.total_cmp(&b.1.efficiency)) {
        let says = if point.efficiency > PLAIN {
            format!(
                "With {} samples, <code>{}</code> has {:.1} times less squared error than plain Monte Carlo at equal \
                 samples, and {:.1} times less at equal time.",
                point.samples,
                method.name(),
                point.gain,
                point.efficiency
            )
        } else {
            "No method is better than plain Monte Carlo here by more than 5 % at equal time.".to_owned()
        };
        let _ = writeln!(page, "<p class=\"says\">{says}</p>");
    }
}

fn images(page: &mut String, report: &SceneReport) {
    let _ = write!(
        page,
        "<h2>At equal time</h2>\n<p>Each in the time that plain Monte Carlo takes for 64 samples.</p>\n\
         <div class=\"images\">\n"
    );
    for (picture, caption) in pictures(report) {
        let _ = writeln!(page, "<figure>{}<figcaption>{caption}</figcaption></figure>", picture.img());
    }
    page.push_str("</div>\n");
}

fn tables(page: &mut String, report: &SceneReport) {
    let Some(plain) = report.curves.first() else { return };
    let mut table = |title: &str, cell: &dyn Fn(&crate::scene::ScenePoint) -> (String, bool)| {
        let heads: String = plain.points.iter().map(|point| format!("<th>{}</th>", point.samples)).collect();
        let mut rows = String::new();
        for curve in &report.curves {
            let cells: String = curve
                .points
                .iter()
                .map(|point| {
                    let (text, good) = cell(point);
                    format!("<td{}>{text}</td>", if good { " class=\"tied\"" } else { "" })
                })
                .collect();
            let _ = writeln!(rows, "<tr><th class=\"stick\"><code>{}</code></th>{cells}</tr>", curve.method.name());
        }
        let _ = write!(
            page,
            "<h2>{title}</h2>\n<div class=\"scroll\"><table class=\"wide\">\n<thead><tr><th>samples</th>{heads}</tr></thead>\n\
             <tbody>\n{rows}</tbody></table></div>\n"
        );
    };
    table("Gain over plain at equal samples", &|point| (format!("{:.2}", point.gain), point.gain > PLAIN));
    table("Gain over plain at equal time", &|point| (format!("{:.2}", point.efficiency), point.efficiency > PLAIN));
    table("Mean squared error", &|point| (format!("{:.2e} ± {:.0e}", point.mse, point.mse_std_error), false));
    table("Mean of error² / (reference² + 0.01)", &|point| (format!("{:.2e}", point.relative_mse), false));
}

fn foot(page: &mut String, report: &SceneReport) {
    let from = &report.provenance;
    let left_out: String = report.needs.explain().iter().map(|line| format!("<li>{line}</li>")).collect();
    let _ = write!(
        page,
        "<h2>What the scene does not need</h2>\n<p>Left out of its kernel:</p>\n<ul>{left_out}</ul>\n\
         <h2>How it was measured</h2>\n<p>Errors are against a reference of {} samples by the defensive ratio, whose own \
         squared error, {:.1e}, is subtracted; means over pixels, channels and replicates. Methods take turns. The \
         numbers are in <code>scene.csv</code> and <code>scene.json</code>.</p>\n\
         <p class=\"soft\">ratiocv {}, {}, {}, {}; {} ({}), {} threads; {}; seed {}; took {:.0} s.</p>\n</body>\n</html>\n",
        report.reference.samples,
        report.reference.mse,
        from.version,
        escaped(from.compiler),
        from.target,
        from.profile,
        escaped(&from.cpu),
        from.level,
        from.threads,
        from.date,
        from.seed,
        from.wall_seconds,
    );
}
