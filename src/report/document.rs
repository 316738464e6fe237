//! A report in every form that it is asked for: text, Markdown, CSV, JSON, HTML.

use serde_json::Value as Json;

use super::bars::BarChart;
use super::chart::Chart;
use super::html;
use super::table::Table;

/// Tables and charts under a title, with the rows behind them.
#[derive(Clone, Debug, Default)]
pub struct Document {
    /// What it is about.
    pub title: String,
    /// What a reader must know to understand the numbers, a paragraph each.
    pub notes: Vec<String>,
    /// In order.
    pub sections: Vec<Section>,
    /// One row for each measured thing with numbers in full, for CSV.
    pub rows: Table,
    /// Everything, for programs.
    pub json: Json,
}

/// A table with charts of the same numbers.
#[derive(Clone, Debug, Default)]
pub struct Section {
    /// What the numbers are.
    pub title: String,
    /// The numbers.
    pub table: Table,
    /// Only in HTML.
    pub figures: Vec<Figure>,
}

/// A picture of numbers.
#[derive(Clone, Debug)]
pub enum Figure {
    /// Lines or dots.
    Chart(Chart),
    /// Bars.
    Bars(BarChart),
}

impl Document {
    /// Title, notes and tables for a terminal.
    pub fn to_text(&self) -> String {
        self.words(Table::to_text, "")
    }

    /// Title, notes and tables in Markdown.
    pub fn to_markdown(&self) -> String {
        self.words(Table::to_markdown, "## ")
    }

    /// The rows with a header line.
    pub fn to_csv(&self) -> String {
        self.rows.to_csv()
    }

    /// A page that needs nothing but itself: no script, no font, no picture from elsewhere.
    pub fn to_html(&self) -> String {
        html::page(self)
    }

    fn words(&self, show: impl Fn(&Table) -> String, heading: &str) -> String {
        let mut parts = vec![format!("{heading}{}\n", self.title)];
        parts.extend(self.notes.iter().map(|note| format!("{note}\n")));
        for section in &self.sections {
            let title = match section.title.as_str() {
                "" => String::new(),
                title => format!("{title}:\n\n"),
            };
            parts.push(format!("{title}{}", show(&section.table)));
        }
        parts.join("\n")
    }
}
