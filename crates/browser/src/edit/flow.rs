//! Values in one line, as people write them.

use serde_yaml::Value as Yaml;

use pushplan::asset::is_in_names;

/// `{cylinder: {radius: 0.05, height: 0.1}}`.
pub fn written(value: &Yaml) -> String {
    match value {
        Yaml::Sequence(items) => {
            format!("[{}]", items.iter().map(written).collect::<Vec<_>>().join(", "))
        }
        Yaml::Mapping(pairs) => {
            let pair = |(key, value)| format!("{}: {}", written(key), written(value));
            format!("{{{}}}", pairs.iter().map(pair).collect::<Vec<_>>().join(", "))
        }
        Yaml::String(text) if is_plain(text) => text.clone(),
        // Words in quotes are the same in both languages.
        Yaml::String(text) => quoted(text),
        // A line of its own is all that is written of anything else.
        other => serde_yaml::to_string(other).unwrap_or_default().trim_end().to_owned(),
    }
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Whether a word stands for itself without quotes.
fn is_plain(text: &str) -> bool {
    let begins = text.chars().next().is_some_and(char::is_alphabetic);
    let reads_as_text = || matches!(serde_yaml::from_str(text), Ok(Yaml::String(_)));
    begins && text.chars().all(is_in_names) && reads_as_text()
}
