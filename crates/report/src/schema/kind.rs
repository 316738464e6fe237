//! Kinds of documents, each with its schema.

use serde_json::{Value as Json, json};

use pushplan::asset::PLAN_VERSION;

use super::shape::{Shape, files};
use super::{belief, bench, checked, design, errors, fit, prediction, run, solution, verdict};

/// Kind of a document that a command prints as JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DocumentKind {
    /// Solution of a task: `solve`.
    Solution,
    /// Verdict on a plan, or on several plans: `verify`.
    Verdict,
    /// Prediction of a motion by several models: `predict` with a task or plan.
    Prediction,
    /// Errors of models on recordings: `predict` with recordings.
    Errors,
    /// Predicted poses: `predict --export`.
    Poses,
    /// Proposed tool: `design`.
    Design,
    /// Run of the closed loop: `run`.
    Run,
    /// Parameters fitted to recordings: `fit`.
    Fit,
    /// Belief about joints and masses: `infer`.
    Belief,
    /// Checked files: `check`.
    Check,
    /// Written files: `export`.
    Export,
    /// Solved task files: `bench tasks`.
    Tasks,
    /// Comparison of tool choices: `bench tools`.
    Tools,
}

impl DocumentKind {
    /// Kinds with their words.
    pub const ALL: [(Self, &'static str); 13] = [
        (Self::Solution, "solution"),
        (Self::Verdict, "verdict"),
        (Self::Prediction, "prediction"),
        (Self::Errors, "errors"),
        (Self::Poses, "poses"),
        (Self::Design, "design"),
        (Self::Run, "run"),
        (Self::Fit, "fit"),
        (Self::Belief, "belief"),
        (Self::Check, "check"),
        (Self::Export, "export"),
        (Self::Tasks, "bench-tasks"),
        (Self::Tools, "bench-tools"),
    ];

    /// Returns the word of the kind.
    pub fn word(self) -> &'static str {
        Self::ALL.iter().find(|(kind, _)| *kind == self).map_or("", |(_, word)| word)
    }

    /// Returns the JSON schema of the document.
    pub fn schema(self) -> Json {
        let mut schema = match self {
            Self::Solution => complete(solution::shape()),
            Self::Verdict => {
                let several = Shape::new().key(
                    "plans",
                    "Verdicts, in the order of the files.",
                    verdict::shape().list(),
                );
                json!({"anyOf": [complete(verdict::shape()), complete(several)]})
            }
            Self::Prediction => complete(prediction::shape()),
            Self::Errors => complete(errors::shape()),
            Self::Poses => complete(prediction::poses()),
            Self::Design => complete(design::shape()),
            Self::Run => complete(run::shape()),
            Self::Fit => complete(fit::shape()),
            Self::Belief => complete(belief::shape()),
            Self::Check => complete(checked::check()),
            Self::Export => complete(checked::export()),
            Self::Tasks => complete(bench::tasks()),
            Self::Tools => {
                json!({"anyOf": [complete(bench::tools()), complete(bench::single())]})
            }
        };
        schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
        schema["title"] = json!(format!("pushplan {} document", self.word()));
        schema["description"] = json!(
            "Lengths are in metres, angles in radians, masses in kilograms, forces in newtons and \
             times in seconds, unless the name of a key ends in `_deg` (degrees)."
        );
        schema
    }
}

/// Returns the schema of a document with its version and the files that were written with it.
fn complete(shape: Shape) -> Json {
    let version = json!({"const": PLAN_VERSION});
    files(shape).key("schema_version", "Version of the document.", version).into()
}
