//! Targets of an evaluation, by name.

use std::str::FromStr;

use crate::bench::{CrowdFamily, SuiteKind};

/// A target of an evaluation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum On {
    /// Pushes of the shipped tools.
    Tools(Vec<SuiteKind>),
    /// Scenes of many objects.
    Crowds(Vec<CrowdFamily>),
}

impl FromStr for On {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        use CrowdFamily::{Dense, Sparse, SparseLine};
        Ok(match text {
            "tools" => On::Tools(SuiteKind::ALL.to_vec()),
            "single" => On::Tools(vec![SuiteKind::Single]),
            "single-any-speed" => On::Tools(vec![SuiteKind::SingleAnySpeed]),
            "touching" => On::Tools(vec![SuiteKind::Touching]),
            "sparse" => On::Crowds(vec![Sparse]),
            "sparse-line" => On::Crowds(vec![SparseLine]),
            "dense" => On::Crowds(vec![Dense]),
            "all" => On::Crowds(vec![Sparse, Dense]),
            file if file.ends_with(".safetensors") => {
                return Err("this is a weights file; give it before --on or after --model".into());
            }
            file if file.contains(['.', '/']) => {
                return Err("for recordings use `pushplan predict FILE...`".into());
            }
            _ => {
                return Err("use tools, single, single-any-speed, touching, sparse, sparse-line, \
                            dense or all"
                    .into());
            }
        })
    }
}
