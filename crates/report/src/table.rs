//! Tables for the terminal, Markdown and CSV.

use pushplan::asset::printable;

/// The content of a cell without a value.
pub const NONE: &str = "\u{2013}";

/// Alignment of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Left, for words.
    Left,
    /// Right, for numbers.
    Right,
}

/// Column of a table: its name, its alignment, and the function that formats a cell.
pub type Column<'a, T> = (&'a str, Align, &'a dyn Fn(&T) -> String);

/// Table of short texts.
#[derive(Clone, Debug, Default)]
pub struct Table {
    columns: Vec<(String, Align)>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// Returns a table without rows.
    pub fn new<'a>(columns: impl IntoIterator<Item = (&'a str, Align)>) -> Self {
        let columns = columns.into_iter().map(|(name, align)| (name.to_owned(), align)).collect();
        Self { columns, rows: Vec::new() }
    }

    /// Returns a table with one row for each of `things`, formatted by `columns`.
    pub fn of<T>(things: impl IntoIterator<Item = T>, columns: &[Column<T>]) -> Self {
        let mut table = Self::new(columns.iter().map(|(name, align, _)| (*name, *align)));
        for thing in things {
            table.row(columns.iter().map(|(_, _, cell)| cell(&thing)));
        }
        table
    }

    /// Adds a row. Missing cells stay empty, surplus cells are dropped, and control characters are
    /// written out.
    pub fn row(&mut self, cells: impl IntoIterator<Item = impl Into<String>>) -> &mut Self {
        let mut row: Vec<String> =
            cells.into_iter().map(|cell| printable(&cell.into()).into_owned()).collect();
        row.resize(self.columns.len(), String::new());
        self.rows.push(row);
        self
    }

    /// Returns `true` if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Returns `true` if there is a header.
    pub fn has_columns(&self) -> bool {
        !self.columns.is_empty()
    }

    /// Formats the table with columns padded by spaces, two between columns, and no trailing
    /// spaces.
    pub fn to_text(&self) -> String {
        let widths = self.widths();
        let header = self.columns.iter().map(|(name, _)| name.as_str());
        let mut text = self.line(header, &widths, "  ");
        for row in &self.rows {
            text.push('\n');
            text.push_str(&self.line(row.iter().map(String::as_str), &widths, "  "));
        }
        text.push('\n');
        text
    }

    /// Formats the table as GitHub Markdown, padded so that its source is readable too.
    pub fn to_markdown(&self) -> String {
        let widths: Vec<usize> = self.widths().into_iter().map(|width| width.max(3)).collect();
        let wrap = |line: String| format!("| {line} |\n");
        let header = self.columns.iter().map(|(name, _)| escape(name)).collect::<Vec<_>>();
        let mut text = wrap(self.padded(header.iter().map(String::as_str), &widths, " | "));
        let rule: Vec<String> = self
            .columns
            .iter()
            .zip(&widths)
            .map(|((_, align), width)| match align {
                Align::Left => "-".repeat(*width),
                Align::Right => format!("{}:", "-".repeat(width - 1)),
            })
            .collect();
        text.push_str(&wrap(rule.join(" | ")));
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(|cell| escape(cell)).collect();
            text.push_str(&wrap(self.padded(cells.iter().map(String::as_str), &widths, " | ")));
        }
        text
    }

    /// Formats the table as comma-separated values (RFC 4180, but with line feeds): the header,
    /// then the rows.
    pub fn to_csv(&self) -> String {
        let quoted = |cell: &str| match cell.contains([',', '"', '\n', '\r']) {
            true => format!("\"{}\"", cell.replace('"', "\"\"")),
            false => cell.to_owned(),
        };
        let line = |cells: Vec<String>| cells.join(",") + "\n";
        let header = line(self.columns.iter().map(|(name, _)| quoted(name)).collect());
        let rows = self.rows.iter().map(|row| line(row.iter().map(|cell| quoted(cell)).collect()));
        header + &rows.collect::<String>()
    }

    /// Returns the names and alignments of the columns.
    pub(super) fn columns(&self) -> &[(String, Align)] {
        &self.columns
    }

    /// Returns the cells, row by row.
    pub(super) fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }

    fn widths(&self) -> Vec<usize> {
        (0..self.columns.len())
            .map(|k| {
                let cells = self.rows.iter().map(|row| escape(&row[k]).chars().count());
                cells.max().unwrap_or(0).max(self.columns[k].0.chars().count())
            })
            .collect()
    }

    fn line<'a>(
        &self,
        cells: impl Iterator<Item = &'a str>,
        widths: &[usize],
        gap: &str,
    ) -> String {
        self.padded(cells, widths, gap).trim_end().to_owned()
    }

    fn padded<'a>(
        &self,
        cells: impl Iterator<Item = &'a str>,
        widths: &[usize],
        gap: &str,
    ) -> String {
        cells
            .zip(widths)
            .zip(&self.columns)
            .map(|((cell, width), (_, align))| {
                let space = " ".repeat(width.saturating_sub(cell.chars().count()));
                match align {
                    Align::Left => format!("{cell}{space}"),
                    Align::Right => format!("{space}{cell}"),
                }
            })
            .collect::<Vec<_>>()
            .join(gap)
    }
}

fn escape(cell: &str) -> String {
    cell.replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Table {
        let mut table = Table::new([("tool", Align::Left), ("error", Align::Right)]);
        table.row(["l-hook", "3.1 mm"]).row(["stick", "\u{2212}12.0 mm"]);
        table
    }

    #[test]
    fn terminal_columns_line_up() {
        insta::assert_snapshot!(sample().to_text(), @r"
        tool       error
        l-hook    3.1 mm
        stick   −12.0 mm
        ");
    }

    #[test]
    fn markdown_keeps_the_alignment() {
        insta::assert_snapshot!(sample().to_markdown(), @r"
        | tool   |    error |
        | ------ | -------: |
        | l-hook |   3.1 mm |
        | stick  | −12.0 mm |
        ");
    }
}
