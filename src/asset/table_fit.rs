//! Files of table fits: small, checked, and bound to one network.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::checksum::checksum;
use crate::scene::TableFit;

use super::diagnostic::{Fault, Faults, Place};
use super::text::read_text;
use super::write_atomic;

/// Version of the file format.
const FIT_VERSION: u32 = 1;

/// Value of the key `kind`.
const KIND: &str = "table_fit";

/// Header that is read first, because another version may have other keys.
#[derive(Deserialize)]
struct Form {
    schema_version: u32,
    kind: String,
}

/// Content of the file, also embedded in plan files.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::asset) struct Whole {
    schema_version: u32,
    kind: String,
    /// Checksum of `fit` as written, hexadecimal.
    checksum: String,
    fit: TableFit,
}

impl Whole {
    pub fn of(fit: &TableFit) -> Self {
        let (checksum, fit) = (fit.checksum(), fit.clone());
        Self { schema_version: FIT_VERSION, kind: KIND.into(), checksum, fit }
    }
}

impl TableFit {
    /// Reads a file written by [`TableFit::write`].
    ///
    /// # Errors
    /// Returns an error if the file cannot be read, has another kind or version, is damaged, or
    /// holds numbers that are impossible in a fit.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = read_text(path.as_ref())?;
        Self::parse(&text, &file).map_err(Faults::from)
    }

    /// Parses the text of a file; `file` is its name in faults.
    ///
    /// # Errors
    /// Returns the errors of [`TableFit::load`].
    pub fn parse(text: &str, file: &str) -> Result<Self, Fault> {
        let again = "create it again with `pushplan fit RECORDINGS --save-fit FILE`";
        let broken = |error: serde_json::Error| {
            let message = error.to_string();
            let message = message.split(" at line ").next().unwrap_or_default();
            let place = Some(Place::in_json(text, error.line(), error.column()));
            Fault { file: file.into(), place, message: message.into(), advice: again.into() }
        };
        let Form { schema_version, kind } = serde_json::from_str(text).map_err(broken)?;
        if kind != KIND {
            let message = format!("expected a table fit, found the kind `{kind}`");
            return Err(Fault::of_file(file, message, again));
        }
        if schema_version != FIT_VERSION {
            let message = format!(
                "the fit has version {schema_version}, but this program reads version {FIT_VERSION}"
            );
            return Err(Fault::of_file(file, message, again));
        }
        let Whole { checksum: written, fit, .. } = serde_json::from_str(text).map_err(broken)?;
        let found = fit.checksum();
        if written != found {
            let message = format!(
                "the fit is damaged: its checksum is {found}, but was {written} when it was written"
            );
            return Err(Fault::of_file(file, message, again));
        }
        match unsound(&fit) {
            None => Ok(fit),
            Some(what) => {
                Err(Fault::of_file(file, format!("a table fit cannot have {what}"), again))
            }
        }
    }

    /// Returns the text of the file.
    pub fn to_json(&self) -> String {
        serde_json::to_string(&Whole::of(self)).unwrap_or_default() + "\n"
    }

    /// Writes the file; a partial file is never left behind.
    ///
    /// # Errors
    /// Returns an error if the path cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Faults> {
        write_atomic(path, self.to_json().as_bytes())
    }

    /// Returns the checksum of all numbers, hexadecimal.
    pub fn checksum(&self) -> String {
        format!("{:016x}", checksum(serde_json::to_string(self).unwrap_or_default().as_bytes()))
    }
}

/// Describes the first value that is impossible in a fit, if any.
fn unsound(fit: &TableFit) -> Option<&'static str> {
    // No correction of a frame exceeds a metre.
    const LARGEST: f64 = 100.0;
    let small = |value: &f64| value.abs() <= LARGEST;
    let positive = |value: f64| (0.0..=LARGEST).contains(&value);
    let directions = &fit.spread.directions;
    let fits = |length: usize| length == fit.head.len();
    if !fit.head.iter().all(small) {
        Some("a head with such numbers")
    } else if !positive(fit.spread.prior) || !positive(fit.noise) {
        Some("this width")
    } else if !directions.iter().all(|one| fits(one.direction.len())) {
        Some("directions whose length differs from the head's")
    } else if !directions.iter().all(|one| (0.0..=1.0).contains(&one.left)) {
        Some("this share of the prior's variance")
    } else if fit.friction.is_some_and(|friction| !positive(friction)) {
        Some("this friction")
    } else if fit.support.is_some_and(|support| !(0.0..=1.0).contains(&support)) {
        Some("this support")
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Shape;
    use crate::scene::{FittedObject, HeadSpread, Narrowed};

    fn some() -> TableFit {
        let shape = Shape::Cylinder { radius: 0.05, height: 0.1 };
        let direction = vec![0.6, -0.8];
        TableFit {
            weights: "0123".into(),
            head: vec![0.1, -1.0 / 3.0],
            spread: HeadSpread { prior: 0.08, directions: vec![Narrowed { left: 0.2, direction }] },
            noise: 6.2e-4,
            friction: Some(0.47),
            support: None,
            table_friction: 0.3,
            objects: vec![FittedObject { name: "can".into(), shape, mass: 0.4 }],
            pushes: 20,
        }
    }

    #[test]
    fn a_fit_is_read_as_it_was_written() {
        assert_eq!(TableFit::parse(&some().to_json(), "table.fit.json"), Ok(some()));
    }

    #[test]
    fn damaged_files_and_those_of_another_kind_are_refused() {
        let text = some().to_json();
        let message =
            |text: &str| TableFit::parse(text, "table.fit.json").expect_err("a fault").message;
        assert!(message(&text.replace("0.47", "0.48")).contains("damaged"));
        assert!(message(&text.replace("table_fit", "plan")).contains("expected a table fit"));
        assert!(message(&text.replace("version\":1", "version\":9")).contains("version 9"));
        assert!(message(&text[..text.len() / 2]).contains("EOF"));
        let wild = TableFit { head: vec![1e9, 0.0], ..some() };
        assert!(message(&wild.to_json()).contains("a table fit cannot have"));
    }
}
