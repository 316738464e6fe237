//! The place of a table on its page: command, mark, measurement, and the numbers.

use super::fingerprint::Fingerprint;
use super::table::Published;

/// Beginning of a mark.
const STALE: &str = "> Stale: ";

/// Beginning of the paragraph about a measurement, and what comes before its inputs.
const MEASURED: &str = "Measured at ";
const INPUTS: &str = "Inputs: ";

/// Circumstances of a measurement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Age {
    /// Commit, with a remark if files differ from it.
    pub commit: String,
    /// Day, as in 2026-11-28.
    pub date: String,
    /// Duration on the wall, minutes.
    pub minutes: String,
    /// Processor and its number of cores.
    pub machine: String,
}

/// Content between the two comments of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Command that made the numbers.
    pub command: String,
    /// Reason to call them stale.
    pub stale: Option<String>,
    /// Paragraph about the measurement; none of an old one.
    pub measured: Option<String>,
    /// The numbers.
    pub body: String,
}

impl Place {
    /// Reads a place; `None` if it does not begin with a command.
    pub fn read(text: &str) -> Option<Self> {
        let (command, mut body) = text.strip_prefix("```sh\n")?.split_once("\n```\n\n")?;
        let mut paragraph = |beginning: &str| {
            let (first, rest) = body.split_once("\n\n")?;
            let found = first.strip_prefix(beginning)?.to_owned();
            body = rest;
            Some(found)
        };
        let (stale, measured) = (paragraph(STALE), paragraph(MEASURED));
        Some(Self { command: command.to_owned(), stale, measured, body: body.to_owned() })
    }

    /// Returns the text of the place.
    pub fn text(&self) -> String {
        let paragraph = |beginning: &str, rest: &Option<String>| {
            rest.as_ref().map_or_else(String::new, |rest| format!("{beginning}{rest}\n\n"))
        };
        let (stale, measured) =
            (paragraph(STALE, &self.stale), paragraph(MEASURED, &self.measured));
        format!("```sh\n{}\n```\n\n{stale}{measured}{}", self.command, self.body)
    }

    /// Returns the place of a table that was measured just now.
    pub fn fresh(table: &Published, body: String, age: &Age, now: &Fingerprint) -> Self {
        let Age { commit, date, minutes, machine } = age;
        let measured = format!(
            "{commit} on {date} in {minutes} min, {machine};\nn = {} {}, standard error of a share \
             \u{2264} {:.1} points.\n{INPUTS}{}.",
            table.count,
            table.unit,
            table.standard_error(),
            now.stated(table.inputs)
        );
        let (command, body) = (table.command.to_owned(), body + "\n");
        Self { command, stale: None, measured: Some(measured), body }
    }

    /// Returns the reason to call the numbers stale today.
    pub fn judge(&self, table: &Published, now: &Fingerprint) -> Option<String> {
        let Some(measured) = &self.measured else {
            let never = || "never measured by its command".to_owned();
            return Some(self.stale.clone().unwrap_or_else(never));
        };
        let inputs = measured.split_once(INPUTS).map_or("", |(_, inputs)| inputs);
        let (then, now) = (inputs.trim_end_matches('.'), now.stated(table.inputs));
        if self.command != table.command {
            Some("measured by another command".to_owned())
        } else if then != now {
            let others = now.split(", ").filter(|input| !then.split(", ").any(|one| one == *input));
            let others = others.collect::<Vec<_>>().join(", ");
            Some(format!("measured with other weights or answers; now {others}"))
        } else {
            None
        }
    }
}
