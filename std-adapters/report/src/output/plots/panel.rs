//! One plot as inline SVG.

use crate::output::plots::axis::{Axis, Scale};
use crate::output::plots::style::{Look, Mark};
use plotters::chart::ChartContext;
use plotters::prelude::*;

/// Pixels, before the page scales it.
const SIZE: (u32, u32) = (560, 370);
const FAINT: RGBColor = RGBColor(226, 226, 226);
const INK: RGBColor = RGBColor(60, 60, 60);

/// A curve, with what surrounds it.
pub(super) struct Series {
    pub(super) look: Look,
    /// The line.
    pub(super) line: Vec<(f64, f64)>,
    /// Marked points; those whose flag is false are drawn hollow.
    pub(super) points: Vec<(f64, f64, bool)>,
    /// (x, lower, upper) of a band about the line.
    pub(super) band: Vec<(f64, f64, f64)>,
    /// (x, lower, upper) of error bars.
    pub(super) bars: Vec<(f64, f64, f64)>,
}

impl Series {
    pub(super) fn new(look: Look) -> Self {
        Self { look, line: vec![], points: vec![], band: vec![], bars: vec![] }
    }
}

/// A plot to be drawn.
pub(super) struct Panel {
    pub(super) title: String,
    pub(super) x: (&'static str, Scale),
    pub(super) y: (&'static str, Scale),
    /// (x, y): a grey area below.
    pub(super) floor: Vec<(f64, f64)>,
    pub(super) series: Vec<Series>,
}

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;
type Failure<'a> = DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>;

impl Panel {
    /// The plot as an `<svg>` element that takes the width it is given.
    pub(super) fn svg(&self) -> String {
        let mut svg = String::new();
        // Drawing into a String fails only where the area is too small for its labels: a constant here.
        if let Err(error) = self.draw(&mut svg) {
            return format!("<p>This plot could not be drawn: {error}</p>");
        }
        let title = self.title.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        svg.replacen("<svg ", &format!("<svg role=\"img\" aria-label=\"{title}\" "), 1)
    }

    fn draw<'a>(&self, svg: &'a mut String) -> Result<(), Failure<'a>> {
        let (x, y) = (self.axis(self.x.1, true), self.axis(self.y.1, false));
        let area = SVGBackend::with_string(svg, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&area)
            .margin(8)
            .margin_right(16)
            .x_label_area_size(46)
            .y_label_area_size(72)
            .build_cartesian_2d(x.clone(), y.clone())?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(FAINT)
            .axis_style(INK)
            .label_style(("sans-serif", 19).into_font().color(&INK))
            .axis_desc_style(("sans-serif", 20).into_font().color(&INK))
            .x_labels(x.labels.len())
            .y_labels(y.labels.len())
            .x_desc(self.x.0)
            .y_desc(self.y.0)
            .draw()?;
        self.draw_floor(&mut chart, &y)?;
        for series in &self.series {
            self.draw_series(&mut chart, series)?;
        }
        area.present()
    }

    fn axis(&self, scale: Scale, horizontal: bool) -> Axis {
        let pick = |x: f64, y: f64| if horizontal { x } else { y };
        let values = self.series.iter().flat_map(|series| {
            let line = series.line.iter().map(|(x, y)| (*x, *y)).chain(series.points.iter().map(|(x, y, _)| (*x, *y)));
            let spans = series.band.iter().chain(&series.bars);
            line.chain(spans.flat_map(|(x, low, high)| [(*x, *low), (*x, *high)])).collect::<Vec<_>>()
        });
        Axis::over(scale, values.map(|(x, y)| pick(x, y)))
    }

    fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.x.1.place(x), self.y.1.place(y))
    }

    fn draw_floor<'a>(&self, chart: &mut Chart<'_, 'a>, y: &Axis) -> Result<(), Failure<'a>> {
        if self.floor.len() < 2 {
            return Ok(());
        }
        let top = self.floor.iter().map(|point| self.place(*point)).map(|(x, top)| (x, top.clamp(y.from, y.to)));
        let bottom = self.floor.iter().rev().map(|point| (self.place(*point).0, y.from));
        chart.draw_series([Polygon::new(top.chain(bottom).collect::<Vec<_>>(), RGBColor(120, 120, 120).mix(0.16))])?;
        Ok(())
    }

    fn draw_series<'a>(&self, chart: &mut Chart<'_, 'a>, series: &Series) -> Result<(), Failure<'a>> {
        let Look { colour, dash: (dash, gap), mark } = series.look;
        if series.band.len() >= 2 {
            let upper = series.band.iter().map(|(x, _, high)| self.place((*x, *high)));
            let lower = series.band.iter().rev().map(|(x, low, _)| self.place((*x, *low)));
            chart.draw_series([Polygon::new(upper.chain(lower).collect::<Vec<_>>(), colour.mix(0.18))])?;
        }
        let bars = series.bars.iter().map(|(x, low, high)| vec![self.place((*x, *low)), self.place((*x, *high))]);
        chart.draw_series(bars.map(|bar| PathElement::new(bar, colour.stroke_width(1))))?;
        let line: Vec<_> = series.line.iter().map(|point| self.place(*point)).collect();
        if gap == 0 {
            chart.draw_series(LineSeries::new(line, colour.stroke_width(2)))?;
        } else {
            chart.draw_series(DashedLineSeries::new(line, dash, gap, colour.stroke_width(2)))?;
        }
        for (x, y, solid) in &series.points {
            draw_mark(chart, self.place((*x, *y)), colour, mark, *solid)?;
        }
        Ok(())
    }
}

fn draw_mark<'a>(
    chart: &mut Chart<'_, 'a>,
    place: (f64, f64),
    colour: RGBColor,
    mark: Mark,
    solid: bool,
) -> Result<(), Failure<'a>> {
    let at = || EmptyElement::at(place);
    let fill = if solid { colour } else { WHITE };
    if mark == Mark::Circle {
        chart.draw_series([at() + Circle::new((0, 0), 4, fill.filled()) + Circle::new((0, 0), 4, colour)])?;
    } else if let Some(first) = mark.corners().first() {
        let corners = mark.corners().to_vec();
        let outline: Vec<_> = corners.iter().copied().chain([*first]).collect();
        chart.draw_series([at() + Polygon::new(corners, fill.filled()) + PathElement::new(outline, colour)])?;
    }
    for stroke in mark.strokes() {
        chart.draw_series([at() + PathElement::new(stroke.to_vec(), colour.stroke_width(2))])?;
    }
    Ok(())
}
