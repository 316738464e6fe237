//! Line and scatter charts as SVG, for training curves and for speed against accuracy.

use pushplan::geometry::Vector;

use super::{
    labels::Labels,
    svg::{Anchor, Font, Style, Svg},
};

pub(super) const SIZE: Vector = Vector::new(600.0, 320.0);
/// Upper left corner of the plot below a legend of one line.
pub(super) const CORNER: Vector = Vector::new(74.0, 66.0);
/// Height of a line of the legend.
pub(super) const LEGEND_LINE: f64 = 18.0;
pub(super) const INK: &str = "#212529";
pub(super) const FAINT_INK: &str = "#6c757d";
/// Palette of Okabe and Ito, distinguishable by colour-blind readers. It repeats with dashes after
/// seven series.
const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#495057"];

/// Axis of a chart.
#[derive(Clone, Debug, Default)]
pub struct Axis {
    /// Quantity on the axis, with its unit.
    pub label: String,
    /// Whether the axis is logarithmic; values that are not positive are then left out.
    pub log: bool,
}

/// Style of the points of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Points joined by a line.
    Line,
    /// Dots without a line.
    Dots,
    /// Dots joined by a line.
    DottedLine,
}

/// Named series of points.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name in the legend; a series without a name or without points has no entry.
    pub name: String,
    /// Points (x, y); points that are not finite are left out.
    pub points: Vec<[f64; 2]>,
    /// Style of the points.
    pub mark: Mark,
    /// Labels next to single points, by index.
    pub labels: Vec<(usize, String)>,
}

/// Line or scatter chart.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Title, bold.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Series; later ones are drawn over earlier ones.
    pub series: Vec<Series>,
}

impl Chart {
    /// Returns the chart as an SVG document.
    pub fn to_svg(&self) -> String {
        self.to_svg_with_id("plot")
    }

    /// Returns the chart with its own `id`, for a page with several charts.
    pub(super) fn to_svg_with_id(&self, id: &str) -> String {
        let shown = |k: usize| {
            let axis = [&self.x, &self.y][k];
            self.series
                .iter()
                .flat_map(|series| &series.points)
                .filter(|point| self.visible(point))
                .map(move |point| axis.place(point[k]))
        };
        let (x, y) = (Range::of(shown(0), self.x.log), Range::of(shown(1), self.y.log));
        let legend = self.legend();
        let lines = legend.iter().map(|(_, place)| place.y).fold(0.0, f64::max);
        let corner = CORNER + Vector::new(0.0, lines);
        let map = |point: &[f64; 2]| {
            corner
                + Vector::new(
                    x.share(self.x.place(point[0])) * SIZE.x,
                    (1.0 - y.share(self.y.place(point[1]))) * SIZE.y,
                )
        };

        let mut svg = Svg::new(corner.x + SIZE.x + 24.0, corner.y + SIZE.y + 52.0, &self.title);
        svg.text(Vector::new(corner.x, 26.0), &self.title, Font::new(16.0, INK).bold());
        svg.rect(corner, SIZE, 0.0, Style::fill("#fbfcfd").outlined("#dee2e6", 1.0));
        self.axes(&mut svg, corner, &x, &y);
        svg.open_clipped(id, corner - Vector::new(6.0, 6.0), SIZE + Vector::new(12.0, 12.0));
        for (k, series) in self.series.iter().enumerate() {
            self.draw(&mut svg, series, k, &map);
        }
        svg.close();
        // Labels are drawn last, so that no dot or line of another series covers them.
        self.label(&mut svg, corner, &map);
        for (k, place) in legend {
            self.draw_legend(&mut svg, k, Vector::new(CORNER.x, 46.0) + place);
        }
        svg.finish()
    }

    fn visible(&self, point: &[f64; 2]) -> bool {
        let fits = |value: f64, axis: &Axis| value.is_finite() && (!axis.log || value > 0.0);
        fits(point[0], &self.x) && fits(point[1], &self.y)
    }

    fn axes(&self, svg: &mut Svg, corner: Vector, x: &Range, y: &Range) {
        let font = Font::new(11.0, FAINT_INK);
        let grid = Style::stroke("#e9ecef", 1.0);
        for (value, label) in x.ticks(self.x.log) {
            let at = corner.x + x.share(value) * SIZE.x;
            let bottom = Vector::new(at, corner.y + SIZE.y);
            svg.line(Vector::new(at, corner.y), bottom, grid);
            svg.text(bottom + Vector::new(0.0, 16.0), &label, font.anchored(Anchor::Middle));
        }
        for (value, label) in y.ticks(self.y.log) {
            let at = corner.y + (1.0 - y.share(value)) * SIZE.y;
            let left = Vector::new(corner.x, at);
            svg.line(left, Vector::new(corner.x + SIZE.x, at), grid);
            svg.text(left + Vector::new(-8.0, 4.0), &label, font.anchored(Anchor::End));
        }
        let font = Font::new(12.0, INK).anchored(Anchor::Middle);
        let below = corner + Vector::new(SIZE.x / 2.0, SIZE.y + 38.0);
        svg.text(below, &self.x.label, font);
        svg.turned_text(Vector::new(20.0, corner.y + SIZE.y / 2.0), -90.0, &self.y.label, font);
    }

    fn draw(
        &self,
        svg: &mut Svg,
        series: &Series,
        index: usize,
        map: &impl Fn(&[f64; 2]) -> Vector,
    ) {
        let points: Vec<Vector> =
            series.points.iter().filter(|point| self.visible(point)).map(map).collect();
        if series.mark != Mark::Dots {
            svg.polyline(&points, line(index, 1.8));
        }
        if series.mark != Mark::Line {
            for point in &points {
                svg.circle(*point, 3.5, Style::fill(colour(index)).outlined("#ffffff", 1.0));
            }
        }
    }

    /// Writes the labels of points, each where it covers least.
    fn label(&self, svg: &mut Svg, corner: Vector, map: &impl Fn(&[f64; 2]) -> Vector) {
        let dotted = self.series.iter().filter(|series| series.mark != Mark::Line);
        let dots = dotted.flat_map(|series| &series.points).filter(|point| self.visible(point));
        let mut labels = Labels::new(corner, SIZE, dots.map(map));
        let font = Font::new(11.0, INK).halo();
        for series in &self.series {
            for (k, words) in &series.labels {
                let point = series.points.get(*k).filter(|point| self.visible(point));
                if let Some(point) = point {
                    svg.text(labels.place(map(point), words, font), words, font);
                }
            }
        }
    }

    /// Returns the series with a name and points, and the position of each legend entry relative to
    /// the legend's upper left corner.
    fn legend(&self) -> Vec<(usize, Vector)> {
        let font = Font::new(12.0, INK);
        let mut next = Vector::zeros();
        let mut places = Vec::new();
        let shown = |series: &Series| {
            !series.name.is_empty() && series.points.iter().any(|point| self.visible(point))
        };
        for (k, series) in self.series.iter().enumerate().filter(|(_, series)| shown(series)) {
            let width = 24.0 + font.width(&series.name);
            if next.x > 0.0 && next.x + width > SIZE.x {
                next = Vector::new(0.0, next.y + LEGEND_LINE);
            }
            places.push((k, next));
            next.x += width + 18.0;
        }
        places
    }

    fn draw_legend(&self, svg: &mut Svg, index: usize, at: Vector) {
        let series = &self.series[index];
        match series.mark {
            Mark::Dots => svg.circle(at + Vector::new(9.0, 0.0), 3.5, Style::fill(colour(index))),
            _ => svg.line(at, at + Vector::new(18.0, 0.0), line(index, 2.4)),
        }
        svg.text(at + Vector::new(24.0, 4.0), &series.name, Font::new(12.0, INK));
    }
}

pub(super) fn colour(index: usize) -> &'static str {
    COLOURS[index % COLOURS.len()]
}

/// Returns the line style of a series; series after the palette repeat its colours, dashed.
fn line(index: usize, width: f64) -> Style {
    let style = Style::stroke(colour(index), width);
    if index < COLOURS.len() { style } else { style.dashed("5 3") }
}

impl Axis {
    /// Returns an axis with equal steps.
    pub fn linear(label: &str) -> Self {
        Self { label: label.to_owned(), log: false }
    }

    /// Returns an axis with powers of ten.
    pub fn log(label: &str) -> Self {
        Self { label: label.to_owned(), log: true }
    }

    fn place(&self, value: f64) -> f64 {
        if self.log { value.log10() } else { value }
    }
}

/// Range of an axis, in axis coordinates (the logarithm on a log axis).
struct Range {
    low: f64,
    high: f64,
}

impl Range {
    fn of(values: impl Iterator<Item = f64>, log: bool) -> Self {
        let (mut low, mut high) = values
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        // A linear axis of amounts begins at zero if that costs little space.
        if !log && low > 0.0 && low < 0.4 * high {
            low = 0.0;
        }
        let spread = if high > low { high - low } else { high.abs().max(1.0) };
        let foot = if !log && low == 0.0 { 0.0 } else { 0.04 * spread };
        Self { low: low - foot, high: high + 0.06 * spread }
    }

    fn share(&self, place: f64) -> f64 {
        (place - self.low) / (self.high - self.low)
    }

    /// Returns the positions and labels of the ticks.
    fn ticks(&self, log: bool) -> Vec<(f64, String)> {
        if log { self.log_ticks() } else { self.linear_ticks() }
    }

    fn linear_ticks(&self) -> Vec<(f64, String)> {
        let rough = (self.high - self.low) / 6.0;
        let power = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|m| m * power)
            .find(|step| *step >= rough)
            .unwrap_or(10.0 * power);
        let digits = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
        ((self.low / step).ceil() as i64..=(self.high / step).floor() as i64)
            .map(|k| k as f64 * step)
            .map(|value| (value, amount(value, digits)))
            .collect()
    }

    fn log_ticks(&self) -> Vec<(f64, String)> {
        // A short axis also has ticks at 2 and 5 between the powers of ten.
        let between: &[f64] = if self.high - self.low < 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        (self.low.floor() as i32..=self.high.ceil() as i32)
            .flat_map(|power| between.iter().map(move |m| (*m, power)))
            .map(|(m, power)| (m.log10() + f64::from(power), m * 10f64.powi(power), power))
            .filter(|(place, ..)| (self.low..=self.high).contains(place))
            .map(|(place, value, power)| (place, amount(value, (-power).clamp(0, 9) as usize)))
            .collect()
    }
}

/// Formats a number, with thousands as k and millions as M.
fn amount(value: f64, digits: usize) -> String {
    let (value, unit, digits) = match value.abs() {
        v if v >= 1e6 => (value / 1e6, "M", 1),
        v if v >= 1e4 => (value / 1e3, "k", 1),
        _ => (value, "", digits),
    };
    let text = format!("{value:.digits$}");
    let text =
        if unit.is_empty() { &text } else { text.trim_end_matches('0').trim_end_matches('.') };
    format!("{text}{unit}")
}

#[cfg(test)]
mod tests;
