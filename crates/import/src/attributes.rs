//! Table of all attributes of elements that are read: each one is used, harmless, noted or refused.
//!
//! Readers look every attribute up here, so that none is left out silently. One text per format
//! holds the rows, beside this file.

use std::collections::HashMap;
use std::sync::LazyLock;

use crate::Language;
use crate::diagnostic::Effect;

/// Treatment of an attribute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Treatment {
    /// Read, with the meaning of the format.
    Used,
    /// Without effect on pushes.
    Harmless,
    /// Not expressed; a note states the effect on motion.
    Noted,
    /// Not expressed; an error.
    Refused,
}

/// Row of the table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    /// Name of the attribute; `*` for all others.
    pub name: &'static str,
    pub treatment: Treatment,
    /// Values without effect, separated by bars; empty if there is none.
    neutral: &'static str,
    /// Effect on motion, or advice.
    pub effect: &'static str,
    /// Strength of the effect.
    pub strength: Effect,
}

/// Rows of a format, by element.
type Table = HashMap<&'static str, Vec<Row>>;

static MJCF: LazyLock<Table> = LazyLock::new(|| table(include_str!("mjcf.attributes")));
static URDF: LazyLock<Table> = LazyLock::new(|| table(include_str!("urdf.attributes")));

/// Returns the treatment of an attribute of an element, such as `geom`, or `equality/weld`; `None`
/// if the attribute is unknown, or the element is not read.
pub fn treatment(language: Language, element: &str, attribute: &str) -> Option<Treatment> {
    row(rows(language, element), attribute).map(|row| row.treatment)
}

/// Returns the rows of an element.
pub(crate) fn rows(language: Language, element: &str) -> &'static [Row] {
    let table = if language == Language::Urdf { &URDF } else { &MJCF };
    table.get(element).map_or(&[], |rows| rows)
}

/// Returns the row of an attribute, or the row of all others.
pub(crate) fn row(rows: &'static [Row], attribute: &str) -> Option<&'static Row> {
    let find = |name: &str| rows.iter().find(|row| row.name == name);
    find(attribute).or_else(|| find("*"))
}

impl Row {
    /// Returns `true` for a value with an effect on motion.
    pub fn applies(&self, value: &str) -> bool {
        let neutral = |word: &str| {
            self.neutral.split('|').any(|neutral| {
                match (word.parse::<f64>(), neutral.parse::<f64>()) {
                    (Ok(number), Ok(neutral)) => number == neutral,
                    (Ok(number), _) if neutral == "-" => number <= 0.0,
                    _ => word == neutral,
                }
            })
        };
        self.neutral.is_empty() || !value.split_whitespace().all(neutral)
    }
}

fn table(text: &'static str) -> Table {
    let (mut table, mut element) = (Table::new(), "");
    for line in text.lines().filter(|line| !line.starts_with('#') && !line.is_empty()) {
        let Some(row) = line.strip_prefix("  ") else {
            element = line;
            continue;
        };
        let (words, effect) = row.split_once(": ").unwrap_or((row, ""));
        let (treatment, words) = words.split_once(' ').unwrap_or((words, ""));
        let strength = match treatment.chars().last() {
            Some('+') => Effect::Strong,
            Some('-') => Effect::Slight,
            _ => Effect::Some,
        };
        let treatment = match treatment.trim_end_matches(['+', '-']) {
            "used" => Treatment::Used,
            "harmless" => Treatment::Harmless,
            "noted" => Treatment::Noted,
            _ => Treatment::Refused,
        };
        table.entry(element).or_default().extend(words.split(' ').map(|word| {
            let (name, neutral) = word.split_once('=').unwrap_or((word, ""));
            Row { name, treatment, neutral, effect, strength }
        }));
    }
    table
}
