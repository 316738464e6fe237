//! Mapping from the table to the page: bounds, scale, grid and scale bar.

use crate::svg::{Anchor, Font, Style, Svg};
use pushplan::decimals::fixed;
use pushplan::geometry::{Footprint, Pose, Vector};

use super::palette;

/// Largest plot, pixels: fits a README column and a laptop screen.
const LARGEST: Vector = Vector::new(820.0, 600.0);
/// Smallest plot, pixels: enough for a title and a legend.
const SMALLEST: Vector = Vector::new(560.0, 300.0);
/// Margin around the content, metres.
const MARGIN: f64 = 0.05;

/// Growing bounding box of the content that must be visible, metres.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    pub low: Vector,
    pub high: Vector,
}

impl Bounds {
    pub fn empty() -> Self {
        let far = Vector::new(f64::INFINITY, f64::INFINITY);
        Self { low: far, high: -far }
    }

    pub fn add(&mut self, point: Vector, margin: f64) {
        if point.iter().all(|v| v.is_finite()) {
            let margin = Vector::new(margin, margin);
            self.low = self.low.inf(&(point - margin));
            self.high = self.high.sup(&(point + margin));
        }
    }

    pub fn add_body(&mut self, footprint: &Footprint, pose: &Pose) {
        for corner in outline(footprint, pose) {
            self.add(corner, 0.0);
        }
    }

    /// Returns `true` if `point` is at most `margin` metres outside.
    pub fn holds(&self, point: Vector, margin: f64) -> bool {
        (0..2).all(|k| (self.low[k] - margin..=self.high[k] + margin).contains(&point[k]))
    }
}

/// Mapping from metres on the table (y up) to pixels (y down).
#[derive(Clone, Copy, Debug)]
pub struct View {
    low: Vector,
    high: Vector,
    scale: f64,
    /// Upper left corner of the plot, pixels.
    pub corner: Vector,
    /// Size of the plot, pixels.
    pub size: Vector,
}

impl View {
    /// Fits `bounds` into a plot with its upper left corner at `corner`.
    pub fn fit(bounds: Bounds, corner: Vector) -> Self {
        Self::fit_into(bounds, corner, [SMALLEST, LARGEST], MARGIN)
    }

    /// Fits `bounds` with a `margin` (metres) into a plot between the smallest and the largest size
    /// (pixels), with its upper left corner at `corner`.
    pub fn fit_into(
        bounds: Bounds,
        corner: Vector,
        [smallest, largest]: [Vector; 2],
        margin: f64,
    ) -> Self {
        let (mut low, mut high) = (bounds.low, bounds.high);
        if !(high.x >= low.x && high.y >= low.y) {
            (low, high) = (Vector::new(-0.5, -0.5), Vector::new(0.5, 0.5));
        }
        let margin = Vector::new(margin, margin);
        (low, high) = (low - margin, high + margin);
        let extent = high - low;
        let scale = (largest.x / extent.x).min(largest.y / extent.y);
        let size = (extent * scale).sup(&smallest);
        let spare = (size / scale - extent) * 0.5;
        Self { low: low - spare, high: high + spare, scale, corner, size }
    }

    pub fn map(&self, point: Vector) -> Vector {
        self.corner
            + Vector::new((point.x - self.low.x) * self.scale, (self.high.y - point.y) * self.scale)
    }

    /// Converts metres to pixels.
    pub fn length(&self, metres: f64) -> f64 {
        metres * self.scale
    }

    pub fn footprint(&self, svg: &mut Svg, footprint: &Footprint, pose: &Pose, style: Style) {
        match *footprint {
            Footprint::Disc { radius } => {
                svg.circle(self.map(pose.position), self.length(radius), style);
            }
            Footprint::Rectangle { .. } | Footprint::Polygon(_) => {
                let corners: Vec<Vector> =
                    outline(footprint, pose).into_iter().map(|corner| self.map(corner)).collect();
                svg.polygon(&corners, style);
            }
        }
    }

    /// Returns a view of the same scale about the origin of a body's own frame.
    pub fn centred(&self) -> Self {
        let zero = Vector::zeros();
        Self { low: zero, high: zero, corner: zero, size: zero, scale: self.scale }
    }

    /// Draws grid lines at every step.
    pub fn grid_lines(&self, svg: &mut Svg) {
        let end = self.corner + self.size;
        for k in self.steps(self.low.x, self.high.x) {
            let x = self.map(Vector::new(k * self.grid_step(), 0.0)).x;
            svg.line(Vector::new(x, self.corner.y), Vector::new(x, end.y), line_style(k));
        }
        for k in self.steps(self.low.y, self.high.y) {
            let y = self.map(Vector::new(0.0, k * self.grid_step())).y;
            svg.line(Vector::new(self.corner.x, y), Vector::new(end.x, y), line_style(k));
        }
    }

    /// Draws grid lines at every step, with numbers along the left and lower edge.
    pub fn grid(&self, svg: &mut Svg) {
        self.grid_named(svg, "x, m", "y, m");
    }

    /// Draws grid lines and numbers, with the given names of the axes.
    pub fn grid_named(&self, svg: &mut Svg, across: &str, up: &str) {
        self.grid_lines(svg);
        let step = self.grid_step();
        let font = Font::new(11.0, palette::FAINT_INK);
        let end = self.corner + self.size;
        let below = end.y + 16.0;
        for k in self.steps(self.low.x, self.high.x).filter(|k| k % 2.0 == 0.0) {
            let x = self.map(Vector::new(k * step, 0.0)).x;
            if x < end.x - 40.0 {
                svg.text(Vector::new(x, below), &label(k * step), font.anchored(Anchor::Middle));
            }
        }
        for k in self.steps(self.low.y, self.high.y).filter(|k| k % 2.0 == 0.0) {
            let y = self.map(Vector::new(0.0, k * step)).y;
            // The top is reserved for the name of the axis.
            if y > self.corner.y + 24.0 {
                let at = Vector::new(self.corner.x - 7.0, y + 4.0);
                svg.text(at, &label(k * step), font.anchored(Anchor::End));
            }
        }
        svg.text(Vector::new(end.x, below), across, font.anchored(Anchor::End));
        let top = Vector::new(self.corner.x - 7.0, self.corner.y + 10.0);
        svg.text(top, up, font.anchored(Anchor::End));
    }

    /// Returns the numbers of the grid lines between two coordinates.
    fn steps(&self, low: f64, high: f64) -> impl Iterator<Item = f64> + use<> {
        let step = self.grid_step();
        ((low / step).ceil() as i64..=(high / step).floor() as i64).map(|k| k as f64)
    }

    /// Draws a bar of one grid step in the lower right corner of the plot.
    pub fn scale_bar(&self, svg: &mut Svg) {
        let step = self.grid_step();
        let end = self.corner + self.size - Vector::new(16.0, 16.0);
        let start = end - Vector::new(self.length(step), 0.0);
        let tick = Vector::new(0.0, 4.0);
        let style = Style::stroke(palette::INK, 1.6);
        svg.line(start, end, style);
        svg.line(start - tick, start + tick, style);
        svg.line(end - tick, end + tick, style);
        let text = if step < 1.0 { format!("{:.0} cm", step * 100.0) } else { format!("{step} m") };
        let font = Font::new(11.0, palette::INK).anchored(Anchor::Middle).halo();
        svg.text((start + end) * 0.5 - Vector::new(0.0, 7.0), &text, font);
    }

    /// Returns the grid step: a round number of metres, between 40 and 100 pixels.
    fn grid_step(&self) -> f64 {
        let wanted = 40.0 / self.scale;
        let power = 10f64.powf(wanted.log10().floor());
        [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|m| m * power)
            .find(|step| *step >= wanted)
            .unwrap_or(10.0 * power)
    }
}

/// Returns the corners of a footprint, or of a disc's bounding square, in the world frame.
pub fn outline(footprint: &Footprint, pose: &Pose) -> Vec<Vector> {
    let around = |half: Vector, pose: &Pose| {
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        corners.map(|(x, y)| pose.point(Vector::new(x * half.x, y * half.y))).to_vec()
    };
    match footprint {
        Footprint::Disc { radius } => {
            around(Vector::new(*radius, *radius), &Pose { heading: 0.0, ..*pose })
        }
        Footprint::Rectangle { half } => around(*half, pose),
        Footprint::Polygon(polygon) => {
            polygon.corners().iter().map(|corner| pose.point(*corner)).collect()
        }
    }
}

fn line_style(k: f64) -> Style {
    if k == 0.0 { palette::GRID_STRONG } else { palette::GRID }
}

fn label(value: f64) -> String {
    let text = fixed(value, 2);
    text.trim_end_matches('0').trim_end_matches('.').replace("-0.", "\u{2212}0.").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn y_points_up_and_both_axes_share_one_scale() {
        let mut bounds = Bounds::empty();
        bounds.add(Vector::new(0.0, 0.0), 0.0);
        bounds.add(Vector::new(1.0, 0.5), 0.0);
        let view = View::fit(bounds, Vector::new(50.0, 60.0));
        let (a, b) = (view.map(Vector::new(0.0, 0.0)), view.map(Vector::new(0.3, 0.3)));
        assert!((b.x - a.x + (b.y - a.y)).abs() < 1e-9 && b.y < a.y);
    }

    #[test]
    fn nothing_to_show_is_still_a_picture() {
        let view = View::fit(Bounds::empty(), Vector::zeros());
        assert!(view.map(Vector::zeros()).iter().all(|v| v.is_finite()));
    }
}
