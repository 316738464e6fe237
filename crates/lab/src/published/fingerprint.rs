//! Digests of the weights and answers that tables depend on.

use std::collections::BTreeMap;
use std::path::Path;
use std::{fs, io};

use pushplan_bench::store::digest;

use crate::bench::Answers;

use super::table::Input;

/// Trained weights and their files.
const WEIGHTS: [(Input, &str); 3] = [
    (Input::Network, "brdpn.safetensors"),
    (Input::Regulator, "regulator.safetensors"),
    (Input::Lever, "lever.safetensors"),
];

/// Number of hexadecimal digits: an accidental match has a chance of one in four thousand millions.
const DIGITS: usize = 8;

/// A digest of every input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fingerprint(BTreeMap<Input, String>);

impl Fingerprint {
    /// Takes the digests of the weights in a folder and of answers.
    ///
    /// # Errors
    /// A weights file that cannot be read.
    pub fn of(weights: &Path, answers: &Answers) -> io::Result<Self> {
        let short = |bytes: &[u8]| digest(bytes)[..DIGITS].to_owned();
        let mut digests = BTreeMap::new();
        for (input, file) in WEIGHTS {
            digests.insert(input, short(&fs::read(weights.join(file))?));
        }
        let answers = [
            (Input::Predictions, &answers.predictions),
            (Input::Plans, &answers.plans),
            (Input::LeverUps, &answers.lever_ups),
            (Input::Beliefs, &answers.beliefs),
        ];
        digests.extend(answers.map(|(input, numbers)| (input, short(text(numbers).as_bytes()))));
        Ok(Self(digests))
    }

    /// Returns names and digests of some inputs, as pages state them.
    pub fn stated(&self, inputs: &[Input]) -> String {
        let stated = inputs.iter().map(|input| format!("{} {}", input.name(), self.0[input]));
        stated.collect::<Vec<_>>().join(", ")
    }

    /// Returns a digest of some inputs together.
    pub fn key(&self, inputs: &[Input]) -> String {
        digest(self.stated(inputs).as_bytes())[..DIGITS].to_owned()
    }
}

/// Numbers to four decimals, a tenth of a millimetre, so that other processors agree.
fn text(numbers: &[f64]) -> String {
    // Adding zero makes -0 positive.
    let rounded =
        numbers.iter().map(|number| format!("{:.4} ", (number * 1e4).round() / 1e4 + 0.0));
    rounded.collect()
}
