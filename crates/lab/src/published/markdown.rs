//! Tables within the Markdown that commands print.

use super::table::{ALL, Pick};

/// Selection of the only table, or of the last lines.
const EVERYTHING: &[Pick] = &[("", ALL, ALL)];

/// Units that a column states once, in its header.
const UNITS: [&str; 8] = ["mm", "%", "\u{b5}s", "ms", "s", "\u{b0}", "times", "m"];

/// Maximum number of published lines of plain text.
const LINES: usize = 12;

/// Maximum number of characters in a line of a title.
const COLUMNS: usize = 100;

/// A table with the line above it.
#[derive(Clone, Debug)]
struct Found {
    title: String,
    header: Vec<String>,
    alignment: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// Returns the published parts of an output: tables with units in their headers, or lines of plain
/// text.
///
/// # Errors
/// Words of the first pick that the output lacks.
pub fn select(output: &str, picks: &[Pick]) -> Result<String, String> {
    let tables = found(output);
    let picks = if picks.is_empty() { EVERYTHING } else { picks };
    if tables.is_empty() {
        return lines(output, picks[0].2);
    }
    let mut parts = Vec::new();
    for pick in picks {
        let table = tables.iter().find(|table| table.title.contains(pick.0));
        let table = table.ok_or_else(|| format!("no table `{}`", pick.0))?.picked(pick)?;
        let title = wrapped(&format!("{}:", table.title)) + "\n\n";
        parts.push(if picks.len() > 1 { title + &table.shown() } else { table.shown() });
    }
    Ok(parts.join("\n"))
}

/// Breaks a line between words.
fn wrapped(line: &str) -> String {
    let (mut text, mut length) = (String::new(), 0);
    for word in line.split(' ') {
        let width = word.chars().count();
        if length > 0 {
            let breaks = length + 1 + width > COLUMNS;
            text.push(if breaks { '\n' } else { ' ' });
            length = if breaks { 0 } else { length + 1 };
        }
        text.push_str(word);
        length += width;
    }
    text
}

/// The last lines of plain text with one of some words.
fn lines(output: &str, words: &[&str]) -> Result<String, String> {
    let wanted = |line: &&str| words.is_empty() || words.iter().any(|word| line.contains(word));
    let lines: Vec<&str> = output.lines().filter(wanted).collect();
    match &lines[lines.len().saturating_sub(LINES)..] {
        [] => Err(format!("no line with {words:?}")),
        last => Ok(format!("```text\n{}\n```\n", last.join("\n"))),
    }
}

/// Returns the tables of an output, in order.
fn found(output: &str) -> Vec<Found> {
    let (mut tables, mut title, mut inside) = (Vec::<Found>::new(), "", false);
    for line in output.lines().map(str::trim) {
        let Some(row) = line.strip_prefix('|').and_then(|line| line.strip_suffix('|')) else {
            inside = false;
            if !line.is_empty() {
                title = line.trim_start_matches('#').trim_end_matches(':').trim();
            }
            continue;
        };
        let row = cells(row);
        match tables.last_mut().filter(|_| inside) {
            None => tables.push(Found {
                title: title.to_owned(),
                header: row,
                alignment: Vec::new(),
                rows: Vec::new(),
            }),
            Some(table) if table.alignment.is_empty() => table.alignment = row,
            Some(table) => table.rows.push(row),
        }
        inside = true;
    }
    tables
}

/// Cells of a row; `\|` is a character of a cell.
fn cells(row: &str) -> Vec<String> {
    let hidden = row.replace("\\|", "\0");
    hidden.split('|').map(|cell| cell.trim().replace('\0', "\\|")).collect()
}

impl Found {
    /// Returns the columns and rows of a pick, with units in the header.
    fn picked(&self, (_, columns, rows): &Pick) -> Result<Self, String> {
        let places = match columns {
            [] => (0..self.header.len()).collect(),
            names => names.iter().map(|name| self.place(name)).collect::<Result<Vec<_>, _>>()?,
        };
        let joined = |row: &[String]| format!("| {} |", row.join(" | "));
        let wanted = |row: &&Vec<String>| {
            rows.is_empty() || rows.iter().any(|words| joined(row).contains(words))
        };
        let of = |row: &Vec<String>| -> Vec<String> {
            places.iter().filter_map(|at| row.get(*at).cloned()).collect()
        };
        let mut table = Self {
            title: self.title.clone(),
            header: of(&self.header),
            alignment: of(&self.alignment).iter().map(|cell: &String| aligned(cell)).collect(),
            rows: self.rows.iter().filter(wanted).map(of).collect(),
        };
        if table.rows.is_empty() {
            return Err(format!("no row with {rows:?} in `{}`", self.title));
        }
        (0..table.header.len()).for_each(|column| table.hoist(column));
        Ok(table)
    }

    /// Index of a column by its name, or by its name and number: `median#1`.
    fn place(&self, name: &str) -> Result<usize, String> {
        let (title, number) = match name.split_once('#') {
            Some((title, number)) => (title, number.parse().unwrap_or(0)),
            None => (name, 0),
        };
        let mut named = (0..self.header.len()).filter(|at| self.header[*at] == title);
        named.nth(number).ok_or_else(|| format!("no column `{name}` in `{}`", self.title))
    }

    /// Moves the unit of a column into its header if all of its numbers have the same.
    fn hoist(&mut self, column: usize) {
        let filled = |row: &&Vec<String>| !matches!(row[column].as_str(), "" | "\u{2013}");
        let cells = || self.rows.iter().filter(filled).map(|row| row[column].as_str());
        let common = |unit: &&str| cells().all(|cell| number_of(cell, unit).is_some());
        let Some(unit) = UNITS.into_iter().find(common).filter(|_| cells().count() > 1) else {
            return;
        };
        for row in &mut self.rows {
            if let Some(number) = number_of(&row[column], unit) {
                row[column] = number.to_owned();
            }
        }
        let header = &mut self.header[column];
        if !header.ends_with('%') {
            *header += &format!(", {}", if unit == "\u{b0}" { "degrees" } else { unit });
        }
    }

    fn shown(&self) -> String {
        let rows = [&self.header, &self.alignment].into_iter().chain(&self.rows);
        rows.map(|row| format!("|{}|\n", row.join("|"))).collect()
    }
}

/// Shortest mark of a column's alignment.
fn aligned(cell: &str) -> String {
    if cell.ends_with(':') { "--:" } else { "---" }.to_owned()
}

/// The number before a unit.
fn number_of<'a>(cell: &'a str, unit: &str) -> Option<&'a str> {
    let number = cell.strip_suffix(unit)?.trim_end();
    let sound = number.chars().all(|c| c.is_ascii_digit() || ".,-+e".contains(c));
    (sound && number.contains(|c: char| c.is_ascii_digit())).then_some(number)
}
