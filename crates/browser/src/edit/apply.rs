//! Application of edits to a text: in place if possible, otherwise by writing the whole text anew.

use serde::Deserialize;
use serde_json::Value as Json;
use serde_yaml::Value as Yaml;

use pushplan::asset::{Fault, Faults, Node, Source};

use super::{change, tree};

/// A change of a YAML text.
#[derive(Clone, Debug, Deserialize)]
pub struct Edit {
    /// Keys and indices that lead to the value. Missing entries on the path are created.
    pub path: Vec<Step>,
    /// New value; `None` removes the key or item.
    #[serde(default)]
    pub value: Option<Json>,
}

/// A step into a map or a list.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
pub enum Step {
    /// The value of this key.
    Key(String),
    /// The item at this index; an index equal to the length appends an item.
    Item(usize),
}

/// Returns the text after all `edits`, one after the other; `file` names it in faults.
///
/// # Errors
/// Returns an error if the text is not YAML or the path of an edit does not exist.
pub fn edit(text: &str, file: &str, edits: &[Edit]) -> Result<String, Faults> {
    let mut text = text.to_owned();
    for one in edits {
        text = edited(&text, file, one)?;
    }
    Ok(text)
}

/// Returns the values of a YAML text.
///
/// # Errors
/// Returns an error if the text is not YAML.
pub fn values(text: &str, file: &str) -> Result<Json, Faults> {
    let root = Node::parse(Source::yaml(file, text))?;
    serde_json::to_value(tree::of(&root)).map_err(|error| unwritable(file, &error))
}

fn edited(text: &str, file: &str, edit: &Edit) -> Result<String, Faults> {
    let source = Source::yaml(file, text);
    let root = Node::parse(source)?;
    let value = edit.value.as_ref().map(serde_yaml::to_value).transpose();
    let value = value.map_err(|error| unwritable(file, &error))?;
    let mut wanted = tree::of(&root);
    if !tree::set(&mut wanted, &edit.path, value.as_ref()) {
        let message = format!("no value at {}", named(&edit.path));
        return Err(Fault::of_file(file, message, "write it into the file").into());
    }
    let reads_as_wanted = |text: &String| {
        Node::parse(Source::yaml(file, text))
            .is_ok_and(|root| tree::same(&tree::of(&root), &wanted))
    };
    let changed = change::at_its_place(source, &root, &edit.path, value.as_ref());
    match changed.filter(reads_as_wanted) {
        Some(text) => Ok(text),
        None => serde_yaml::to_string(&wanted).map_err(|error| unwritable(file, &error)),
    }
}

/// Returns a path in readable form.
fn named(path: &[Step]) -> String {
    let words = path.iter().map(|step| match step {
        Step::Key(key) => key.clone(),
        Step::Item(index) => (index + 1).to_string(),
    });
    format!("`{}`", words.collect::<Vec<_>>().join("."))
}

fn unwritable(file: &str, error: &dyn std::error::Error) -> Faults {
    let message = format!("cannot write its values: {error}");
    Fault::of_file(file, message, "keys of maps must be text").into()
}

/// Returns the entry of `value` at `step`.
pub(super) fn entry<'a>(value: &'a mut Yaml, step: &Step) -> Option<&'a mut Yaml> {
    match step {
        Step::Key(key) => value.as_mapping_mut()?.get_mut(key.as_str()),
        Step::Item(index) => value.as_sequence_mut()?.get_mut(*index),
    }
}

#[cfg(test)]
mod tests;
