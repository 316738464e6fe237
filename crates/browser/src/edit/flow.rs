//! Values in one line, as in hand-written files.

use serde_yaml::Value as Yaml;

use pushplan::asset::is_in_names;

/// Returns a value in flow style, as in `{cylinder: {radius: 0.05, height: 0.1}}`.
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
        // Quoted words are written alike in YAML and JSON.
        Yaml::String(text) => quoted(text),
        // Every other value is written as a single line.
        other => serde_yaml::to_string(other).unwrap_or_default().trim_end().to_owned(),
    }
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Returns `true` if a word needs no quotes.
fn is_plain(text: &str) -> bool {
    let begins = text.chars().next().is_some_and(char::is_alphabetic);
    let reads_as_text = || matches!(serde_yaml::from_str(text), Ok(Yaml::String(_)));
    begins && text.chars().all(is_in_names) && reads_as_text()
}
