//! Kinds of JSON schemas: files that users write or that commands read back, and the documents that
//! commands print with `--json`.

use clap::builder::PossibleValuesParser;
use serde_json::Value as Json;

use pushplan::asset::{
    plan_schema, recording_schema, task_schema, tool_schema, trajectory_schema, world_schema,
};
use pushplan_report::DocumentKind;

/// Word of a kind of file, and its schema.
type FileKind = (&'static str, fn() -> Json);

/// Kinds of files with their schemas.
const FILES: [FileKind; 6] = [
    ("tool", tool_schema),
    ("task", task_schema),
    ("recording", recording_schema),
    ("world", world_schema),
    ("plan", plan_schema),
    ("trajectory", trajectory_schema),
];

/// Returns a parser of the words of all kinds.
pub fn kinds() -> PossibleValuesParser {
    let files = FILES.iter().map(|(word, _)| *word);
    files.chain(DocumentKind::ALL.iter().map(|(_, word)| *word)).collect::<Vec<_>>().into()
}

/// Returns the schema of a kind that [`kinds`] accepts.
pub fn of(word: &str) -> Json {
    let file = FILES.iter().find(|(known, _)| *known == word).map(|(_, schema)| schema());
    let document = || DocumentKind::ALL.iter().find(|(_, known)| *known == word);
    file.or_else(|| document().map(|(kind, _)| kind.schema())).unwrap_or_default()
}
