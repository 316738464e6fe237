//! A published table: its page, command, cost, samples and inputs.

use super::registry::SUBJECTS;

/// Selection of every column or row.
pub(super) const ALL: &[&str] = &[];

/// Published part of a command's output: words of a table's title, its columns, and words of its
/// rows. `name#1` is the second column of that name. The rows of plain text are its lines.
pub type Pick = (&'static str, &'static [&'static str], &'static [&'static str]);

/// Input that numbers of a table depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Input {
    /// Weights of the network of pushes.
    Network,
    /// Weights of the belief regulator.
    Regulator,
    /// Weights of the network of lever-ups.
    Lever,
    /// Predicted ends of fixed pushes.
    Predictions,
    /// Draft plans of fixed tasks, with their verdicts.
    Plans,
    /// Draft plans of fixed tasks of levering, with their verdicts.
    LeverUps,
    /// Beliefs after fixed observations.
    Beliefs,
}

impl Input {
    /// Name on pages.
    pub fn name(self) -> &'static str {
        match self {
            Input::Network => "network",
            Input::Regulator => "regulator",
            Input::Lever => "lever",
            Input::Predictions => "predictions",
            Input::Plans => "plans",
            Input::LeverUps => "lever-ups",
            Input::Beliefs => "beliefs",
        }
    }
}

/// A published table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Published {
    /// Unique name.
    pub name: &'static str,
    /// File name of its page.
    pub page: &'static str,
    /// Shell command that measures it, to be run in the root of the repository.
    pub command: &'static str,
    /// Estimated processor time, minutes.
    pub minutes: u16,
    /// Number of samples.
    pub count: u32,
    /// Name of a sample, in the plural.
    pub unit: &'static str,
    /// Weights and answers that its numbers depend on.
    pub inputs: &'static [Input],
    /// Published parts of the output; none means everything.
    pub picks: &'static [Pick],
}

impl Published {
    /// Largest standard error of a share over the samples, percentage points.
    pub fn standard_error(&self) -> f64 {
        50.0 / f64::from(self.count).sqrt()
    }
}

/// Returns an entry of the registry.
pub(super) const fn table(
    name: &'static str,
    page: &'static str,
    (minutes, count, unit): (u16, u32, &'static str),
    inputs: &'static [Input],
    command: &'static str,
    picks: &'static [Pick],
) -> Published {
    Published { name, page, command, minutes, count, unit, inputs, picks }
}

/// Returns all published tables, by subject.
pub fn tables() -> impl Iterator<Item = &'static Published> {
    SUBJECTS.iter().copied().flatten()
}
