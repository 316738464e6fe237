//! Reports in all output formats: text, Markdown, CSV, JSON, HTML, figure files.

use std::path::PathBuf;

use serde_json::{Value as Json, json};

use pushplan::asset::PLAN_VERSION;

use super::bars::BarChart;
use super::chart::Chart;
use super::html;
use super::table::Table;

/// Tables and pictures under a title, with the underlying rows.
#[derive(Clone, Debug, Default)]
pub struct Document {
    /// Title; empty if the document continues the one before.
    pub title: String,
    /// Notes that explain the numbers, a paragraph each.
    pub notes: Vec<String>,
    /// Sections, in order.
    pub sections: Vec<Section>,
    /// Rows of measurements, one each, with full-precision numbers, for CSV.
    pub rows: Table,
    /// Complete content for programs: a JSON object.
    pub json: Json,
}

/// A table, lines below it, and pictures of the same numbers.
#[derive(Clone, Debug, Default)]
pub struct Section {
    /// Title, which names the numbers.
    pub title: String,
    /// Table of the numbers.
    pub table: Table,
    /// Lines below the table.
    pub lines: Vec<String>,
    /// Figures, in HTML and as files.
    pub figures: Vec<Figure>,
}

/// A picture with its file name.
#[derive(Clone, Debug)]
pub struct Figure {
    /// File name without extension.
    pub name: String,
    /// Content of the figure.
    pub drawing: Drawing,
}

/// Content of a figure.
#[derive(Clone, Debug)]
pub enum Drawing {
    /// Line or scatter chart.
    Chart(Chart),
    /// Bar chart.
    Bars(BarChart),
    /// Finished SVG document.
    Svg(String),
}

impl Document {
    /// Returns title, notes, tables and lines for a terminal.
    pub fn to_text(&self) -> String {
        self.words(Table::to_text, "", false)
    }

    /// Returns title, notes, tables and lines in Markdown, as part of a page.
    pub fn to_markdown(&self) -> String {
        self.words(Table::to_markdown, "## ", false)
    }

    /// Returns a complete Markdown page, to be stored next to its figure files.
    pub fn to_page(&self) -> String {
        self.words(Table::to_markdown, "# ", true)
    }

    /// Returns the rows as CSV with a header line.
    pub fn to_csv(&self) -> String {
        self.rows.to_csv()
    }

    /// Returns the complete content as JSON, with the schema version.
    pub fn to_json(&self) -> String {
        let mut report = self.json.clone();
        unsign_zeros(&mut report);
        report["schema_version"] = json!(PLAN_VERSION);
        format!("{report:#}\n")
    }

    /// Returns a self-contained HTML page without scripts or external resources.
    pub fn to_html(&self) -> String {
        html::page(self)
    }

    /// Returns the figures of all sections.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.sections.iter().flat_map(|section| &section.figures)
    }

    /// Adds a line for each written file at the end of the document.
    pub fn wrote(&mut self, files: &[PathBuf]) {
        let lines = files.iter().map(|file| format!("wrote {}", file.display()));
        match self.sections.last_mut() {
            Some(last) => last.lines.extend(lines),
            None => self.sections.push(Section { lines: lines.collect(), ..Section::default() }),
        }
        self.json["files"] = json!(files);
    }

    fn words(&self, show: impl Fn(&Table) -> String, heading: &str, figures: bool) -> String {
        let mut parts = Vec::new();
        if !self.title.is_empty() {
            parts.push(format!("{heading}{}\n", self.title));
        }
        parts.extend(self.notes.iter().map(|note| format!("{note}\n")));
        for section in &self.sections {
            if !section.title.is_empty() {
                parts.push(format!("{}:\n", section.title));
            }
            if section.table.has_columns() {
                parts.push(show(&section.table));
            }
            if !section.lines.is_empty() {
                parts.push(section.lines.iter().map(|line| format!("{line}\n")).collect());
            }
            for figure in section.figures.iter().filter(|_| figures) {
                parts.push(format!("![{}]({})\n", figure.title(), figure.file_name()));
            }
        }
        parts.join("\n")
    }
}

/// Replaces every -0 by 0.
fn unsign_zeros(value: &mut Json) {
    match value {
        Json::Number(number) if number.as_f64() == Some(0.0) && !number.is_u64() => {
            *value = json!(0.0);
        }
        Json::Array(values) => values.iter_mut().for_each(unsign_zeros),
        Json::Object(fields) => fields.values_mut().for_each(unsign_zeros),
        _ => {}
    }
}

impl Figure {
    /// Returns a figure of a chart, with the file name `name`.
    pub fn chart(name: impl Into<String>, chart: Chart) -> Self {
        Self { name: name.into(), drawing: Drawing::Chart(chart) }
    }

    /// Returns a figure of bars, with the file name `name`.
    pub fn bars(name: impl Into<String>, bars: BarChart) -> Self {
        Self { name: name.into(), drawing: Drawing::Bars(bars) }
    }

    /// Returns a figure of a finished SVG document, with the file name `name`.
    pub fn svg(name: impl Into<String>, svg: String) -> Self {
        Self { name: name.into(), drawing: Drawing::Svg(svg) }
    }

    /// Returns the file name with extension.
    pub fn file_name(&self) -> String {
        format!("{}.svg", self.name)
    }

    /// Returns the figure as an SVG document.
    pub fn to_svg(&self) -> String {
        match &self.drawing {
            Drawing::Chart(chart) => chart.to_svg(),
            Drawing::Bars(bars) => bars.to_svg(),
            Drawing::Svg(svg) => svg.clone(),
        }
    }

    fn title(&self) -> &str {
        match &self.drawing {
            Drawing::Chart(chart) => &chart.title,
            Drawing::Bars(bars) => &bars.title,
            Drawing::Svg(_) => &self.name,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_has_no_sign_in_json() {
        let document = Document {
            json: json!({"a": [-0.0, -0.5, 0], "b": {"c": -0.0}}),
            ..Document::default()
        };
        let text = document.to_json();
        let read: Json = serde_json::from_str(&text).expect("JSON");
        assert_eq!((&read["a"], &read["b"]), (&json!([0.0, -0.5, 0]), &json!({"c": 0.0})));
        assert!(!text.contains("-0.0"), "{text}");
    }
}
