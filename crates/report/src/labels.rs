//! Placement of labels next to points, without overlaps and within the chart.

use pushplan::geometry::Vector;

use super::svg::Font;

/// Half the side of the square around a dot, pixels.
const DOT: f64 = 5.0;
/// Distance of a label from its point along each axis, pixels.
const GAP: Vector = Vector::new(6.0, 6.0);
/// Height of letters above their baseline and below it, in units of the font size.
const ABOVE: f64 = 0.78;
const BELOW: f64 = 0.22;
/// Cost of covering another label, relative to covering a dot. A dot stays half visible because
/// labels have a light rim.
const OVER_WORDS: f64 = 10.0;

/// Occupied areas of a chart, for the placement of labels.
pub(super) struct Labels {
    /// Area of the plot, in which labels are placed if possible.
    plot: Rect,
    dots: Vec<Rect>,
    words: Vec<Rect>,
}

impl Labels {
    /// Returns an empty set of labels for a plot with its upper left `corner`, and `dots` at the
    /// given positions, pixels.
    pub fn new(corner: Vector, size: Vector, dots: impl Iterator<Item = Vector>) -> Self {
        let square = Vector::new(DOT, DOT);
        let dots = dots.map(|at| Rect { low: at - square, high: at + square }).collect();
        Self { plot: Rect { low: corner, high: corner + size }, dots, words: Vec::new() }
    }

    /// Places `words` next to the dot at `point` and returns the start of their baseline. The
    /// position that covers least is chosen. Ties are resolved in the order right above, right
    /// below, left above, left below, above, below.
    pub fn place(&mut self, point: Vector, words: &str, font: Font) -> Vector {
        let width = font.width(words);
        let (right, left, middle) = (GAP.x, -GAP.x - width, -0.5 * width);
        let (up, down) = (-GAP.y, GAP.y + ABOVE * font.size);
        let places = [
            (right, up),
            (right, down),
            (left, up),
            (left, down),
            (middle, up - 2.0),
            (middle, down + 2.0),
        ];
        let boxed = |(x, y): (f64, f64)| {
            let start = point + Vector::new(x, y);
            let low = start - Vector::new(0.0, ABOVE * font.size);
            (start, Rect { low, high: start + Vector::new(width, BELOW * font.size) })
        };
        let (start, taken) = places
            .map(boxed)
            .into_iter()
            .min_by(|(_, a), (_, b)| self.covered(a).total_cmp(&self.covered(b)))
            .unwrap_or_else(|| boxed(places[0]));
        self.words.push(taken);
        start
    }

    /// Returns the cost of a position: pixels covered, weighted as for labels outside the plot.
    fn covered(&self, place: &Rect) -> f64 {
        let over = |taken: &[Rect]| -> f64 { taken.iter().map(|other| place.common(other)).sum() };
        let outside = place.common(place) - place.common(&self.plot);
        over(&self.dots) + OVER_WORDS * (over(&self.words) + outside)
    }
}

/// Axis-aligned rectangle, pixels.
struct Rect {
    low: Vector,
    high: Vector,
}

impl Rect {
    /// Returns the intersection area with `other`, square pixels.
    fn common(&self, other: &Self) -> f64 {
        let side = self.high.inf(&other.high) - self.low.sup(&other.low);
        side.x.max(0.0) * side.y.max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FONT: Font = Font::new(10.0, "#000");

    fn labels(dots: &[Vector]) -> Labels {
        Labels::new(Vector::zeros(), Vector::new(200.0, 100.0), dots.iter().copied())
    }

    #[test]
    fn words_stand_right_above_where_there_is_room() {
        let point = Vector::new(50.0, 50.0);
        assert_eq!(labels(&[point]).place(point, "one", FONT), point + Vector::new(6.0, -6.0));
    }

    #[test]
    fn words_at_the_right_edge_go_left() {
        let point = Vector::new(190.0, 50.0);
        let start = labels(&[point]).place(point, "thorough", FONT);
        assert!(start.x + FONT.width("thorough") < point.x, "{start}");
    }

    #[test]
    fn close_points_have_words_apart() {
        let points = [0.0, 1.0, 2.0, 3.0].map(|k| Vector::new(100.0 + k, 50.0));
        let mut labels = labels(&points);
        for point in points {
            labels.place(point, "network", FONT);
        }
        for (k, a) in labels.words.iter().enumerate() {
            assert_eq!(labels.words[..k].iter().map(|b| a.common(b)).sum::<f64>(), 0.0);
            assert_eq!(a.common(&labels.plot), a.common(a));
        }
    }

    #[test]
    fn words_do_not_cover_dots_where_another_place_is_free() {
        let point = Vector::new(50.0, 50.0);
        let dots = [point, point + Vector::new(15.0, -10.0)];
        let mut labels = labels(&dots);
        labels.place(point, "one", FONT);
        assert!(labels.dots.iter().all(|dot| dot.common(&labels.words[0]) == 0.0));
    }
}
