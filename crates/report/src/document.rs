//! A report in every form that it is asked for: text, Markdown, CSV, JSON, HTML, files.

use std::path::PathBuf;

use serde_json::{Value as Json, json};

use pushplan::asset::PLAN_VERSION;

use super::bars::BarChart;
use super::chart::Chart;
use super::html;
use super::table::Table;

/// Tables and pictures under a title, with the rows behind them.
#[derive(Clone, Debug, Default)]
pub struct Document {
    /// What it is about; empty where it continues the one before.
    pub title: String,
    /// What a reader must know to understand the numbers, in paragraphs.
    pub notes: Vec<String>,
    /// In order.
    pub sections: Vec<Section>,
    /// One row for each measured thing with numbers in full, for CSV.
    pub rows: Table,
    /// Everything, for programs: an object.
    pub json: Json,
}

/// A table, what follows from it, and pictures of the same numbers.
#[derive(Clone, Debug, Default)]
pub struct Section {
    /// What the numbers are.
    pub title: String,
    /// The numbers.
    pub table: Table,
    /// Below them, a line each.
    pub lines: Vec<String>,
    /// In HTML and as files.
    pub figures: Vec<Figure>,
}

/// A picture with the name that its file gets.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of the file without its ending.
    pub name: String,
    /// What it shows.
    pub drawing: Drawing,
}

/// What a figure shows.
#[derive(Clone, Debug)]
pub enum Drawing {
    /// Lines or dots.
    Chart(Chart),
    /// Bars.
    Bars(BarChart),
    /// A finished SVG document.
    Svg(String),
}

impl Document {
    /// Title, notes, tables and lines for a terminal.
    pub fn to_text(&self) -> String {
        self.words(Table::to_text, "", false)
    }

    /// Title, notes, tables and lines in Markdown, as part of a page.
    pub fn to_markdown(&self) -> String {
        self.words(Table::to_markdown, "## ", false)
    }

    /// The same as a page of its own, next to the files of its figures.
    pub fn to_page(&self) -> String {
        self.words(Table::to_markdown, "# ", true)
    }

    /// The rows with a header line.
    pub fn to_csv(&self) -> String {
        self.rows.to_csv()
    }

    /// Everything, for programs.
    pub fn to_json(&self) -> String {
        let mut report = self.json.clone();
        report["schema_version"] = json!(PLAN_VERSION);
        format!("{report:#}\n")
    }

    /// A self-contained page: no script, no font, no picture from elsewhere.
    pub fn to_html(&self) -> String {
        html::page(self)
    }

    /// The figures of all sections.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.sections.iter().flat_map(|section| &section.figures)
    }

    /// Says which files were written, in a line each below everything else.
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

impl Figure {
    /// A chart that gets the file name `name`.
    pub fn chart(name: impl Into<String>, chart: Chart) -> Self {
        Self { name: name.into(), drawing: Drawing::Chart(chart) }
    }

    /// Bars that get the file name `name`.
    pub fn bars(name: impl Into<String>, bars: BarChart) -> Self {
        Self { name: name.into(), drawing: Drawing::Bars(bars) }
    }

    /// A finished SVG document that gets the file name `name`.
    pub fn svg(name: impl Into<String>, svg: String) -> Self {
        Self { name: name.into(), drawing: Drawing::Svg(svg) }
    }

    /// Name of its file.
    pub fn file_name(&self) -> String {
        format!("{}.svg", self.name)
    }

    /// The picture as an SVG document.
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
