//! The legend below the plot: samples with words, in as many rows as needed.

use crate::svg::{Font, Style, Svg};
use pushplan::geometry::Vector;

use super::{joints::Symbol, palette};

const ROW: f64 = 21.0;
const SAMPLE: f64 = 26.0;
const FONT: Font = Font::new(12.0, palette::INK);

/// Sample next to the words.
#[derive(Clone, Copy, Debug)]
pub enum Sample {
    /// Small box.
    Area(Style),
    /// Circle, as for the goal.
    Ring(Style),
    /// Line with an outlined disc at its end, as for a path.
    Way(Style),
    /// Numbered push.
    Push,
    /// Joint symbol.
    Joint(Symbol),
}

/// Returns the height of the legend in pixels for a width of `width` pixels.
pub fn height(entries: &[(Sample, String)], width: f64) -> f64 {
    places(entries, width).last().map_or(0.0, |at| at.y + ROW)
}

/// Draws the legend with its upper left corner at `corner`.
pub fn draw(svg: &mut Svg, entries: &[(Sample, String)], corner: Vector, width: f64) {
    for ((sample, words), place) in entries.iter().zip(places(entries, width)) {
        let at = corner + place;
        let middle = at + Vector::new(SAMPLE / 2.0, ROW / 2.0);
        match *sample {
            Sample::Area(style) => {
                svg.rect(middle - Vector::new(10.0, 6.0), Vector::new(20.0, 12.0), 1.0, style);
            }
            Sample::Ring(style) => svg.circle(middle, 7.0, style),
            Sample::Way(style) => {
                let end = middle + Vector::new(6.0, 0.0);
                svg.polyline(&[middle - Vector::new(13.0, 0.0), end], style);
                svg.circle(end, 5.5, style);
            }
            Sample::Joint(symbol) => symbol.draw(svg, middle, Vector::x(), 0.0, palette::INK),
            Sample::Push => {
                let half = Vector::new(12.0, 0.0);
                svg.arrow(middle - half, middle + half, 9.0, palette::INK, 2.0);
            }
        }
        svg.text(at + Vector::new(SAMPLE + 7.0, ROW / 2.0 + 4.0), words, FONT);
    }
}

fn places(entries: &[(Sample, String)], width: f64) -> Vec<Vector> {
    let mut at = Vector::zeros();
    entries
        .iter()
        .map(|(_, words)| {
            let needed = SAMPLE + 7.0 + FONT.width(words) + 18.0;
            if at.x > 0.0 && at.x + needed > width {
                at = Vector::new(0.0, at.y + ROW);
            }
            let place = at;
            at.x += needed;
            place
        })
        .collect()
}
