//! Grouped bar charts as SVG: shares by kind of task and method.

use pushplan::geometry::Vector;

use super::chart::{CORNER, FAINT_INK, INK, LEGEND_LINE, SIZE, colour};
use super::svg::{Anchor, Font, Style, Svg};

/// Share of a group's width that its bars fill.
const FILLED: f64 = 0.8;

/// Number of grid intervals across the plot.
const LINES: usize = 5;

/// Bars of one series, one in every group.
#[derive(Clone, Debug)]
pub struct Bars {
    /// Name in the legend.
    pub name: String,
    /// Share of each group, 0 to 1; `None` where the share is unknown.
    pub shares: Vec<Option<f64>>,
}

/// Chart of shares side by side, from 0 to 100 %.
#[derive(Clone, Debug, Default)]
pub struct BarChart {
    /// Title, bold.
    pub title: String,
    /// Description of the shares, on the axis.
    pub label: String,
    /// Names of the groups, from left to right.
    pub groups: Vec<String>,
    /// Series, from left to right within each group.
    pub bars: Vec<Bars>,
}

impl BarChart {
    /// Returns the chart as an SVG document.
    pub fn to_svg(&self) -> String {
        let legend = self.legend();
        let lines = legend.iter().map(|place| place.y).fold(0.0, f64::max);
        let corner = CORNER + Vector::new(0.0, lines);
        let mut svg = Svg::new(corner.x + SIZE.x + 24.0, corner.y + SIZE.y + 36.0, &self.title);
        svg.text(Vector::new(corner.x, 26.0), &self.title, Font::new(16.0, INK).bold());
        svg.rect(corner, SIZE, 0.0, Style::fill("#fbfcfd").outlined("#dee2e6", 1.0));
        let faint = Font::new(11.0, FAINT_INK);
        for k in 0..=LINES {
            let share = k as f64 / LINES as f64;
            let left = corner + Vector::new(0.0, (1.0 - share) * SIZE.y);
            svg.line(left, left + Vector::new(SIZE.x, 0.0), Style::stroke("#e9ecef", 1.0));
            let at = left + Vector::new(-8.0, 4.0);
            svg.text(at, &percent(share), faint.anchored(Anchor::End));
        }
        let font = Font::new(12.0, INK).anchored(Anchor::Middle);
        svg.turned_text(Vector::new(20.0, corner.y + SIZE.y / 2.0), -90.0, &self.label, font);
        let wide = SIZE.x / self.groups.len().max(1) as f64;
        let bar = FILLED * wide / self.bars.len().max(1) as f64;
        for (g, group) in self.groups.iter().enumerate() {
            let left = corner.x + g as f64 * wide;
            let below = Vector::new(left + wide / 2.0, corner.y + SIZE.y + 20.0);
            svg.text(below, group, faint.anchored(Anchor::Middle));
            for (k, bars) in self.bars.iter().enumerate() {
                let Some(share) = bars.shares.get(g).copied().flatten().filter(|s| s.is_finite())
                else {
                    continue;
                };
                let high = share.clamp(0.0, 1.0) * SIZE.y;
                let x = left + (1.0 - FILLED) / 2.0 * wide + k as f64 * bar;
                let at = Vector::new(x, corner.y + SIZE.y - high);
                svg.open_titled(&format!("{group}, {}: {}", bars.name, percent(share)));
                svg.rect(at, Vector::new(0.94 * bar, high), 0.0, Style::fill(colour(k)));
                svg.close();
            }
        }
        for (k, place) in legend.into_iter().enumerate() {
            let at = Vector::new(CORNER.x, 46.0) + place;
            let box_at = at - Vector::new(0.0, 5.0);
            svg.rect(box_at, Vector::new(14.0, 10.0), 1.0, Style::fill(colour(k)));
            let text_at = at + Vector::new(20.0, 4.0);
            svg.text(text_at, &self.bars[k].name, Font::new(12.0, INK));
        }
        svg.finish()
    }

    /// Returns the position of each legend entry, relative to the legend's upper left corner.
    fn legend(&self) -> Vec<Vector> {
        let font = Font::new(12.0, INK);
        let mut next = Vector::zeros();
        let mut places = Vec::new();
        for bars in &self.bars {
            let width = 20.0 + font.width(&bars.name);
            if next.x > 0.0 && next.x + width > SIZE.x {
                next = Vector::new(0.0, next.y + LEGEND_LINE);
            }
            places.push(next);
            next.x += width + 18.0;
        }
        places
    }
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_known_share_is_a_bar_as_high_as_it_is_large() {
        let bars = |name: &str, shares: &[Option<f64>]| Bars {
            name: name.to_owned(),
            shares: shares.to_vec(),
        };
        let chart = BarChart {
            groups: vec!["reach".into(), "pull & <sweep>".into()],
            bars: vec![
                bars("network", &[Some(1.0), Some(0.5)]),
                bars("nothing", &[None, Some(f64::NAN)]),
            ],
            ..BarChart::default()
        };
        let svg = chart.to_svg();
        assert_eq!(svg.matches("</g>").count(), 2);
        assert!(svg.contains("height=\"320\"") && svg.contains("height=\"160\""), "{svg}");
        assert!(svg.contains("pull &amp; &lt;sweep&gt;, network: 50 %"));
        assert!(BarChart::default().to_svg().ends_with("</svg>\n"));
    }
}
