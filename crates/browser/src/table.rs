//! The text of a task, its content, and its changes.

use pushplan::asset::{self, Fault, Faults, parse_task};
use pushplan::{Task, ToolLibrary};
use pushplan_report::task_stage;
use serde_json::{Value as Json, json};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::edit::{self, Edit};
use crate::library;

/// Returns the names of the shipped tasks.
#[wasm_bindgen]
pub fn examples() -> Vec<String> {
    Task::examples().map(str::to_owned).collect()
}

/// Returns the text of a shipped task.
///
/// # Errors
/// Returns an error if there is no task of this name.
#[wasm_bindgen]
pub fn example(name: &str) -> Result<String, String> {
    asset::example_text(name).map(str::to_owned).map_err(|faults| faults.to_string())
}

/// Returns a minimal task to start from.
#[wasm_bindgen]
pub fn bare() -> String {
    include_str!("bare.yaml").to_owned()
}

/// Returns the names of the shipped tools as JSON: tools that push, and tools that lever.
///
/// # Errors
/// Returns an error if the library was built with damaged tools.
#[wasm_bindgen]
pub fn tools() -> Result<String, String> {
    let library = library()?;
    let names = |wanted: fn(&pushplan::Tool) -> bool| -> Vec<&str> {
        let tools = library.iter().chain(library.blades());
        let mut names: Vec<&str> =
            tools.filter(|tool| wanted(tool)).map(|tool| tool.name.as_str()).collect();
        names.dedup();
        names
    };
    let lever = |tool: &pushplan::Tool| tool.blade().is_some();
    Ok(json!({"push": names(pushplan::Tool::pushes), "lever": names(lever)}).to_string())
}

/// Returns the content of a text as JSON: `values` as written, `stage` as drawn by a page, and
/// `faults`. Unknown content is null.
#[wasm_bindgen]
pub fn look(text: &str, file: &str) -> String {
    let values = edit::values(text, file).unwrap_or_default();
    let task = library().map_err(|error| Fault::of_file(file, error, "").into());
    let task = task.and_then(|library: &ToolLibrary| parse_task(text, file, library));
    let (stage, faults) = match &task {
        Ok(task) => (task_stage(task), Vec::new()),
        Err(faults) => (Json::Null, listed(faults)),
    };
    let levers = task.is_ok_and(|task| task.levers.is_some());
    json!({"values": values, "stage": stage, "levers": levers, "faults": faults}).to_string()
}

/// Returns the text after changes, which are a JSON list of `{path, value}`. A change without a
/// value removes the entry.
///
/// # Errors
/// Returns an error if the text is not YAML or a path does not exist.
#[wasm_bindgen]
pub fn edit(text: &str, file: &str, edits: &str) -> Result<String, String> {
    let edits: Vec<Edit> = serde_json::from_str(edits).map_err(|error| error.to_string())?;
    edit::edit(text, file, &edits).map_err(|faults| faults.to_string())
}

fn listed(faults: &Faults) -> Vec<Json> {
    let one = |fault: &Fault| {
        let place = fault.place.map(|place| (place.line, place.column));
        json!({
            "line": place.map(|(line, _)| line), "column": place.map(|(_, column)| column),
            "message": fault.message, "advice": fault.advice,
        })
    };
    faults.0.iter().map(one).collect()
}
