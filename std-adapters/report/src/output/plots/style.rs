//! Colours, dashes and marks.

use plotters::style::RGBColor;

/// How an estimator is drawn; told apart by mark and dash where colours are not seen.
#[derive(Clone, Copy)]
pub(crate) struct Look {
    pub(super) colour: RGBColor,
    /// Lengths of dash and gap; gap 0 for a solid line.
    pub(super) dash: (u32, u32),
    pub(super) mark: Mark,
}

/// The shape of a point.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    None,
    Circle,
    Square,
    Diamond,
    Up,
    Down,
    Cross,
    Plus,
}

// Okabe and Ito (2008), without the yellow, which is too faint on white.
pub(super) const BLACK: RGBColor = RGBColor(0, 0, 0);
pub(super) const ORANGE: RGBColor = RGBColor(230, 159, 0);
pub(super) const SKY: RGBColor = RGBColor(86, 180, 233);
pub(super) const GREEN: RGBColor = RGBColor(0, 158, 115);
pub(super) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(super) const VERMILLION: RGBColor = RGBColor(213, 94, 0);
pub(super) const PURPLE: RGBColor = RGBColor(204, 121, 167);
pub(super) const GREY: RGBColor = RGBColor(118, 118, 118);

/// How the estimator of that id is drawn, defensive or not.
pub(crate) fn look(id: &str) -> Look {
    let (colour, dash, mark) = match id.trim_start_matches("defensive_") {
        "ratio" => (BLUE, (1, 0), Mark::Circle),
        "quenouille" => (GREY, (6, 3), Mark::Plus),
        "beale" => (SKY, (6, 3), Mark::Down),
        "tin" => (ORANGE, (2, 3), Mark::Cross),
        "mean_of_ratios" | "naive_ratio" => (PURPLE, (9, 4), Mark::Diamond),
        "hartley_ross" => (VERMILLION, (1, 0), Mark::Square),
        "difference" => (ORANGE, (1, 0), Mark::Cross),
        "mickey" => (GREEN, (1, 0), Mark::Up),
        "regression_ratio" => (SKY, (1, 0), Mark::Diamond),
        "shared_regression_ratio" => (SKY, (6, 3), Mark::Diamond),
        "choose" => (PURPLE, (1, 0), Mark::Plus),
        _ => (BLACK, (4, 4), Mark::None),
    };
    Look { colour, dash, mark }
}

impl Mark {
    /// Corners in pixels about the point, y downwards; none for what is not a polygon.
    pub(super) fn corners(self) -> &'static [(i32, i32)] {
        match self {
            Self::Square => &[(-3, -3), (3, -3), (3, 3), (-3, 3)],
            Self::Diamond => &[(0, -5), (5, 0), (0, 5), (-5, 0)],
            Self::Up => &[(0, -5), (4, 3), (-4, 3)],
            Self::Down => &[(0, 5), (4, -3), (-4, -3)],
            Self::None | Self::Circle | Self::Cross | Self::Plus => &[],
        }
    }

    /// Strokes in pixels about the point.
    pub(super) fn strokes(self) -> &'static [[(i32, i32); 2]] {
        match self {
            Self::Cross => &[[(-4, -4), (4, 4)], [(-4, 4), (4, -4)]],
            Self::Plus => &[[(-4, 0), (4, 0)], [(0, -4), (0, 4)]],
            _ => &[],
        }
    }
}

/// A piece of line for a legend.
pub(crate) fn swatch(look: Look) -> String {
    let RGBColor(r, g, b) = look.colour;
    let colour = format!("#{r:02x}{g:02x}{b:02x}");
    let (dash, gap) = look.dash;
    let dashes = if gap == 0 { String::new() } else { format!(" stroke-dasharray=\"{dash} {gap}\"") };
    let at = |(x, y): (i32, i32)| format!("{},{}", 17 + x, 7 + y);
    let mark = match look.mark {
        Mark::Circle => format!("<circle cx=\"17\" cy=\"7\" r=\"3.5\" fill=\"{colour}\"/>"),
        mark if !mark.corners().is_empty() => {
            let corners: Vec<_> = mark.corners().iter().map(|corner| at(*corner)).collect();
            format!("<polygon points=\"{}\" fill=\"{colour}\"/>", corners.join(" "))
        }
        mark => mark
            .strokes()
            .iter()
            .map(|[from, to]| {
                format!("<polyline points=\"{} {}\" stroke=\"{colour}\" stroke-width=\"1.6\"/>", at(*from), at(*to))
            })
            .collect(),
    };
    format!(
        "<svg class=\"swatch\" viewBox=\"0 0 34 14\" width=\"34\" height=\"14\" aria-hidden=\"true\">\
         <line x1=\"0\" y1=\"7\" x2=\"34\" y2=\"7\" stroke=\"{colour}\" stroke-width=\"1.8\"{dashes}/>{mark}</svg>"
    )
}
