//! A small SVG writer with pixel coordinates, y down, and short numbers.
//!
//! The writer is independent of scenes and charts. Every document starts with an opaque background,
//! so that it looks the same in light and dark viewers.

use std::fmt::Write;

use pushplan::asset::printable;
use pushplan::geometry::Vector;

use super::keyframes::short;

/// Font families in order of preference; all ship with common systems, none is embedded.
const FONTS: &str = "Inter, 'Segoe UI', 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif";

/// Mean advance of a character in units of the font size, an estimate because text cannot be
/// measured here.
const ADVANCE: f64 = 0.58;

/// Fill and outline of a shape. Colours are SVG colours; widths and dashes are in pixels.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    fill: &'static str,
    stroke: &'static str,
    width: f64,
    dash: &'static str,
    opacity: f64,
}

impl Style {
    /// Returns a filled style without outline.
    pub const fn fill(colour: &'static str) -> Self {
        Self { fill: colour, stroke: "none", width: 0.0, dash: "", opacity: 1.0 }
    }

    /// Returns an outlined style without fill.
    pub const fn stroke(colour: &'static str, width: f64) -> Self {
        Self { fill: "none", stroke: colour, width, dash: "", opacity: 1.0 }
    }

    /// Returns this style with an outline.
    pub const fn outlined(self, colour: &'static str, width: f64) -> Self {
        Self { stroke: colour, width, ..self }
    }

    /// Returns this style with a dashed outline.
    pub const fn dashed(self, dash: &'static str) -> Self {
        Self { dash, ..self }
    }

    /// Returns this style with the given opacity: 0 is invisible, 1 opaque.
    pub const fn opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    fn write(&self, out: &mut String) {
        let _ = write!(out, " fill=\"{}\"", self.fill);
        if self.stroke != "none" {
            let _ = write!(out, " stroke=\"{}\" stroke-width=\"{}\"", self.stroke, px(self.width));
        }
        if !self.dash.is_empty() {
            let _ = write!(out, " stroke-dasharray=\"{}\"", self.dash);
        }
        if self.opacity < 1.0 {
            let _ = write!(out, " opacity=\"{}\"", px(self.opacity));
        }
    }
}

/// Horizontal alignment of a text relative to its anchor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The text starts at the anchor.
    Start,
    /// The text is centred at the anchor.
    Middle,
    /// The text ends at the anchor.
    End,
}

/// Appearance of a text.
#[derive(Clone, Copy, Debug)]
pub struct Font {
    /// Height, pixels.
    pub size: f64,
    /// Colour.
    pub colour: &'static str,
    /// Whether the text is bold.
    pub bold: bool,
    /// Alignment to the anchor.
    pub anchor: Anchor,
    /// Whether the text has a light rim, which keeps it readable over lines.
    pub halo: bool,
}

impl Font {
    /// Returns a plain font, aligned to the start.
    pub const fn new(size: f64, colour: &'static str) -> Self {
        Self { size, colour, bold: false, anchor: Anchor::Start, halo: false }
    }

    /// Returns this font in bold.
    pub const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// Returns this font with another alignment.
    pub const fn anchored(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// Returns this font with a light rim.
    pub const fn halo(self) -> Self {
        Self { halo: true, ..self }
    }

    /// Returns the estimated width of `text`, pixels.
    pub fn width(&self, text: &str) -> f64 {
        text.chars().count() as f64 * self.size * if self.bold { ADVANCE + 0.04 } else { ADVANCE }
    }

    /// Breaks `text` at spaces into lines of at most about `width` pixels.
    pub fn wrap(&self, text: &str, width: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            match lines.last_mut() {
                Some(line) if self.width(line) + self.width(word) + self.size < width => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.to_owned()),
            }
        }
        lines
    }
}

/// SVG document under construction.
#[derive(Clone, Debug)]
pub struct Svg {
    width: f64,
    height: f64,
    title: String,
    body: String,
}

impl Svg {
    /// Returns an empty white document of the given size in pixels; `title` is the accessible name.
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: escape(title), body: String::new() }
    }

    /// Inserts raw definitions (patterns, markers, clip paths) at the current position.
    pub fn define(&mut self, raw: &str) {
        let _ = writeln!(self.body, "<defs>{raw}</defs>");
    }

    /// Opens a group that is clipped to a rectangle; close it with [`Svg::close`].
    pub fn open_clipped(&mut self, id: &str, corner: Vector, size: Vector) {
        let (x, y, w, h) = (px(corner.x), px(corner.y), px(size.x), px(size.y));
        self.define(&format!(
            "<clipPath id=\"{id}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/>\
             </clipPath>"
        ));
        let _ = writeln!(self.body, "<g clip-path=\"url(#{id})\">");
    }

    /// Opens a group with a tooltip; close it with [`Svg::close`].
    pub fn open_titled(&mut self, title: &str) {
        let _ = writeln!(self.body, "<g><title>{}</title>", escape(title));
    }

    /// Opens a group with an opacity from 0 to 1; close it with [`Svg::close`].
    pub fn open_faded(&mut self, opacity: f64) {
        let _ = writeln!(self.body, "<g opacity=\"{}\">", px(opacity));
    }

    /// Inserts a style sheet at the current position.
    pub fn style(&mut self, css: &str) {
        let _ = writeln!(self.body, "<style>\n{css}\n</style>");
    }

    /// Opens a group of the given class for animation by a style sheet; close it with
    /// [`Svg::close`]. Without animation, the group is shifted by `shift` pixels and rotated by
    /// `degrees` clockwise.
    pub fn open_moved(&mut self, class: &str, shift: Vector, degrees: f64) {
        let _ = write!(self.body, "<g class=\"{class}\"");
        let mut moves = Vec::new();
        if shift != Vector::zeros() {
            moves.push(format!("translate({} {})", px(shift.x), px(shift.y)));
        }
        if degrees != 0.0 {
            moves.push(format!("rotate({})", px(degrees)));
        }
        if !moves.is_empty() {
            let _ = write!(self.body, " transform=\"{}\"", moves.join(" "));
        }
        self.body.push_str(">\n");
    }

    /// Opens a group of the given class for animation by a style sheet; close it with
    /// [`Svg::close`]. Without animation, the group has the given opacity, 0 to 1.
    pub fn open_shown(&mut self, class: &str, opacity: f64) {
        let _ = writeln!(self.body, "<g class=\"{class}\" opacity=\"{}\">", px(opacity));
    }

    /// Draws a line of the given class with a path length of 1. A style sheet can draw it
    /// progressively by its `stroke-dashoffset` from 1 to 0.
    pub fn drawn_line(&mut self, class: &str, points: &[Vector], style: Style) {
        let head = format!("polyline class=\"{class}\" pathLength=\"1\"");
        self.points(&head, points, style.dashed("1"));
    }

    /// Closes the last opened group.
    pub fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// Draws a rectangle with rounded corners.
    pub fn rect(&mut self, corner: Vector, size: Vector, radius: f64, style: Style) {
        let _ = write!(
            self.body,
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\"",
            px(corner.x),
            px(corner.y),
            px(size.x),
            px(size.y),
            px(radius)
        );
        self.end(style);
    }

    /// Draws a circle.
    pub fn circle(&mut self, centre: Vector, radius: f64, style: Style) {
        let _ = write!(
            self.body,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"",
            px(centre.x),
            px(centre.y),
            px(radius)
        );
        self.end(style);
    }

    /// Draws a straight line.
    pub fn line(&mut self, from: Vector, to: Vector, style: Style) {
        let _ = write!(
            self.body,
            "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"",
            px(from.x),
            px(from.y),
            px(to.x),
            px(to.y)
        );
        self.end(style);
    }

    /// Draws a line through points.
    pub fn polyline(&mut self, points: &[Vector], style: Style) {
        self.points("polyline", points, style);
    }

    /// Draws a closed polygon.
    pub fn polygon(&mut self, points: &[Vector], style: Style) {
        self.points("polygon", points, style);
    }

    /// Draws a polygon that cycles through the outlines `ways` in an endless loop of `seconds`.
    /// Viewers without animation show the last outline.
    pub fn moving_polygon(&mut self, ways: &[Vec<Vector>], seconds: f64, style: Style) {
        let point = |p: &Vector| format!("{},{}", px(p.x), px(p.y));
        let list = |way: &Vec<Vector>| way.iter().map(point).collect::<Vec<_>>().join(" ");
        let values: Vec<String> = ways.iter().map(list).collect();
        let last = values.last().map_or("", String::as_str);
        let _ = write!(self.body, "<polygon points=\"{last}\"");
        style.write(&mut self.body);
        let (how, values) = ("calcMode=\"discrete\" repeatCount=\"indefinite\"", values.join(";"));
        let _ = write!(self.body, "><animate attributeName=\"points\" {how} dur=\"{seconds:.2}s\"");
        let _ = writeln!(self.body, " values=\"{values}\"/></polygon>");
    }

    /// Draws a straight arrow with a filled head of `head` pixels.
    pub fn arrow(&mut self, from: Vector, to: Vector, head: f64, colour: &'static str, width: f64) {
        let along = to - from;
        let length = along.norm();
        if length < 1e-6 {
            return;
        }
        let unit = along / length;
        let side = Vector::new(-unit.y, unit.x) * (0.5 * head);
        let neck = to - unit * head.min(length);
        self.line(from, neck + unit * 0.5, Style::stroke(colour, width));
        self.polygon(&[to, neck + side, neck - side], Style::fill(colour));
    }

    /// Writes a line of text; the anchor is on its baseline.
    pub fn text(&mut self, at: Vector, text: &str, font: Font) {
        self.turned_text(at, 0.0, text, font);
    }

    /// Writes a line of text, rotated by `degrees` clockwise about its anchor.
    pub fn turned_text(&mut self, at: Vector, degrees: f64, text: &str, font: Font) {
        let _ = write!(
            self.body,
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"",
            px(at.x),
            px(at.y),
            px(font.size),
            font.colour
        );
        match font.anchor {
            Anchor::Start => {}
            Anchor::Middle => self.body.push_str(" text-anchor=\"middle\""),
            Anchor::End => self.body.push_str(" text-anchor=\"end\""),
        }
        if font.bold {
            self.body.push_str(" font-weight=\"600\"");
        }
        if font.halo {
            self.body.push_str(
                " stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\" \
                 paint-order=\"stroke\"",
            );
        }
        if degrees != 0.0 {
            let _ = write!(
                self.body,
                " transform=\"rotate({} {} {})\"",
                px(degrees),
                px(at.x),
                px(at.y)
            );
        }
        let _ = writeln!(self.body, ">{}</text>", escape(text));
    }

    /// Returns the finished document.
    pub fn finish(self) -> String {
        let (w, h) = (px(self.width), px(self.height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" \
             height=\"{h}\" font-family=\"{FONTS}\" role=\"img\">\n<title>{}</title>\n\
             <rect width=\"{w}\" height=\"{h}\" rx=\"8\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.title, self.body
        )
    }

    fn points(&mut self, tag: &str, points: &[Vector], style: Style) {
        let _ = write!(self.body, "<{tag} points=\"");
        for (k, point) in points.iter().enumerate() {
            let gap = if k == 0 { "" } else { " " };
            let _ = write!(self.body, "{gap}{},{}", px(point.x), px(point.y));
        }
        self.body.push_str("\" stroke-linejoin=\"round\" stroke-linecap=\"round\"");
        self.end(style);
    }

    fn end(&mut self, style: Style) {
        style.write(&mut self.body);
        self.body.push_str("/>\n");
    }
}

/// Formats a number of pixels to a hundredth, without trailing zeros. Values that are not finite
/// become 0, so that a broken prediction still leaves a readable picture.
fn px(value: f64) -> String {
    short(value, 2)
}

/// Escapes text for an element or a quoted attribute. Control characters are written out because
/// XML has none.
pub(super) fn escape(text: &str) -> String {
    printable(text)
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_break_out_of_the_document() {
        let mut svg = Svg::new(10.0, 10.0, "a <b> & \"c\"");
        svg.text(Vector::new(1.0, 2.0), "</svg>\u{1b}[2J", Font::new(8.0, "#000"));
        let text = svg.finish();
        assert!(text.contains("&lt;/svg&gt;\\u001b[2J</text>"), "{text}");
        assert_eq!(text.matches("</svg>").count(), 1);
        assert!(text.contains("a &lt;b&gt; &amp; &quot;c&quot;"));
    }

    #[test]
    fn numbers_are_short_and_finite() {
        let shown: Vec<String> = [1.0, 0.126, -0.001, f64::NAN, 12.5].into_iter().map(px).collect();
        assert_eq!(shown, ["1", "0.13", "0", "0", "12.5"]);
    }
}
