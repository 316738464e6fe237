//! Strict check of a tree against the specification of a file, and the ledger of faults.

use super::diagnostic::{Fault, Faults, Place, did_you_mean, one_of};
use super::node::{Content, Node};
use super::reader::locate;
use super::spec::{Key, Range, Value};
use super::text::{LONGEST_NAME, Source, is_in_names};

/// Maximum number of faults shown; further faults are only counted, because a wrong file would
/// produce too many.
const MAX_SHOWN: usize = 50;

/// Collection of faults by node; places are looked up at the end.
pub(super) struct Ledger<'a> {
    source: Source<'a>,
    found: Vec<(usize, String, String)>,
}

impl<'a> Ledger<'a> {
    pub fn new(source: Source<'a>) -> Self {
        Self { source, found: Vec::new() }
    }

    /// Adds a fault at `node`.
    pub fn fault(&mut self, node: &Node, message: impl Into<String>, advice: impl Into<String>) {
        self.found.push((node.id, message.into(), advice.into()));
    }

    /// Checks that no fault has been added so far.
    ///
    /// # Errors
    /// Returns all faults added so far.
    pub fn sound(&self) -> Result<(), Faults> {
        if self.found.is_empty() {
            return Ok(());
        }
        Self { source: self.source, found: self.found.clone() }.finish(None)
    }

    /// Returns `value` if it exists and no fault was added.
    pub fn finish<T>(mut self, value: Option<T>) -> Result<T, Faults> {
        if let (Some(value), true) = (value, self.found.is_empty()) {
            return Ok(value);
        }
        if self.found.is_empty() {
            // A missing value normally has a fault; this is the fallback for a rule that added
            // none.
            let fault = Fault {
                file: self.source.file.into(),
                place: Some(Place { line: 1, column: 1 }),
                message: "the file is incomplete".into(),
                advice: String::new(),
            };
            return Err(fault.into());
        }
        self.found.sort_by_key(|(id, ..)| *id);
        // A goal of several objects is checked for each of them.
        self.found.dedup();
        let more = self.found.len().saturating_sub(MAX_SHOWN);
        let mut faults: Vec<Fault> = self
            .found
            .drain(..)
            .take(MAX_SHOWN)
            .map(|(id, message, advice)| Fault {
                file: self.source.file.into(),
                place: locate(self.source, id),
                message,
                advice,
            })
            .collect();
        if more > 0 {
            faults.push(Fault::of_file(self.source.file, format!("and {more} more"), ""));
        }
        Err(Faults(faults))
    }
}

/// Checks `node` against `value` and adds every fault. Faulty values are emptied, so that later
/// rules can use all valid values and no fault is repeated.
pub(super) fn check(node: &mut Node, value: &Value, ledger: &mut Ledger) {
    match value {
        Value::Anything => {}
        Value::Nothing if node.content == Content::Nothing => {}
        Value::Switch if matches!(node.content, Content::Switch(_)) => {}
        Value::Text if node.text().is_some() => {}
        Value::Name if node.text().is_some() => check_name(node, ledger),
        Value::Word(words) if node.text().is_some() => check_word(node, words, ledger),
        Value::Number(range) if node.number().is_some() => check_range(node, range, ledger),
        Value::Count(range) if matches!(node.content, Content::Whole(_)) => {
            check_range(node, range, ledger);
        }
        Value::List { of, min, max, .. } if matches!(node.content, Content::List(_)) => {
            let fits = (*min..=*max).contains(&node.items().len());
            if let Content::List(items) = &mut node.content {
                items.iter_mut().for_each(|item| check(item, of, ledger));
            }
            if !fits {
                reject(node, value, ledger);
            }
        }
        Value::Map(keys) if matches!(node.content, Content::Map(_)) => {
            let unknown = check_keys(node, keys, ledger);
            for key in keys.iter().filter(|key| key.required && node.get(key.name).is_none()) {
                // A misspelled key is one fault, not two.
                if !unknown.iter().any(|advice| advice.contains(&format!("`{}`?", key.name))) {
                    let message = format!("missing key `{}`", key.name);
                    ledger.fault(node, message, key.meaning);
                }
            }
        }
        Value::Variant(keys) if matches!(node.content, Content::Map(_)) => {
            let unknown = check_keys(node, keys, ledger);
            let given = keys.iter().filter(|key| node.get(key.name).is_some()).count();
            if given > 1 || (given == 0 && unknown.is_empty()) {
                reject(node, value, ledger);
            }
        }
        Value::Dependent { by, .. } => check(node, by(node), ledger),
        Value::Either(values) => match values.iter().find(|value| same_kind(node, value)) {
            // A wrong word may be a misspelling of another form of the value.
            Some(Value::Word(words)) if !words.iter().any(|word| node.text() == Some(word)) => {
                reject(node, value, ledger);
            }
            Some(value) => check(node, value, ledger),
            None => reject(node, value, ledger),
        },
        _ => reject(node, value, ledger),
    }
}

/// Keys by which other programs tilt objects.
const TILTS: [&str; 12] = [
    "axis",
    "euler",
    "lying",
    "orientation",
    "pitch",
    "pitch_deg",
    "quat",
    "quaternion",
    "roll",
    "roll_deg",
    "rotation",
    "rpy",
];

/// Checks the keys of a map and the values of the known keys; returns the advice for the unknown
/// keys.
fn check_keys(node: &mut Node, keys: &[Key], ledger: &mut Ledger) -> Vec<String> {
    let mut unknown = Vec::new();
    let mut seen = Vec::new();
    let Content::Map(pairs) = &mut node.content else { return unknown };
    for (key, value) in pairs {
        let Some(name) = key.text().map(str::to_owned) else {
            ledger.fault(key, format!("expected a key, found {}", key.content), "");
            continue;
        };
        if seen.contains(&name) {
            let message = format!("key `{name}` is given twice");
            ledger.fault(key, message, "keep one of the two");
            continue;
        }
        match keys.iter().find(|known| known.name == name) {
            Some(known) => check(value, &known.value, ledger),
            None => {
                let advice = tilted(&name, keys)
                    .unwrap_or_else(|| did_you_mean(&name, keys.iter().map(|key| key.name)));
                ledger.fault(key, format!("unknown key `{name}`"), advice.clone());
                unknown.push(advice);
            }
        }
        seen.push(name);
    }
    unknown
}

/// Returns the advice for a key that tilts an upright body.
fn tilted(name: &str, keys: &[Key]) -> Option<String> {
    let stands = keys.iter().any(|key| ["yaw_deg", "radius"].contains(&key.name));
    (stands && TILTS.contains(&name)).then(|| {
        "all bodies stand upright and rotate by `yaw_deg` only: write a lying box with other \
         sizes; a lying can would roll, which is not modelled"
            .to_owned()
    })
}

fn check_name(node: &mut Node, ledger: &mut Ledger) {
    let name = node.text().unwrap_or_default();
    if name.is_empty() || name.chars().count() > LONGEST_NAME || !name.chars().all(is_in_names) {
        reject(node, &Value::Name, ledger);
    }
}

fn check_word(node: &mut Node, words: &[&str], ledger: &mut Ledger) {
    let word = node.text().unwrap_or_default();
    if !words.contains(&word) {
        let known: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        let message = format!("expected {}, found `{word}`", one_of(&known));
        let advice = did_you_mean(word, words.iter().copied());
        ledger.fault(node, message, advice);
        node.content = Content::Nothing;
    }
}

fn check_range(node: &mut Node, range: &Range, ledger: &mut Ledger) {
    // NaN is in no range.
    if !node.number().is_some_and(|x| (range.low..=range.high).contains(&x)) {
        let message = format!("expected {}, found {}", in_range(range), node.content);
        ledger.fault(node, message, range.advice);
        node.content = Content::Nothing;
    }
}

/// Adds the fault that `node` is not a `value`, and empties the node.
fn reject(node: &mut Node, value: &Value, ledger: &mut Ledger) {
    let numeric = matches!(value, Value::Number(_) | Value::Count(_));
    let number = node.text().filter(|_| numeric).and_then(|text| text.trim().parse::<f64>().ok());
    let found = match (&node.content, number) {
        // YAML reads numbers that are too large, such as 1e999, as text.
        (_, Some(x)) if x.is_infinite() => "a number beyond 1e308".into(),
        (content, _) => content.to_string(),
    };
    let message = format!("expected {}, found {found}", describe(value));
    let advice = match (&node.content, value) {
        (_, Value::Number(range) | Value::Count(range))
            if number.is_some_and(|x| !x.is_finite()) =>
        {
            range.advice.into()
        }
        // YAML reads a number with a leading zero as text.
        (Content::Text(text), _) if number.is_some() && bare(text) != text.as_str() => {
            format!("write {}, without quotes and leading zeros", bare(text))
        }
        _ if number.is_some() => "remove the quotes".into(),
        (Content::Text(_), Value::Number(range) | Value::Count(range)) => {
            format!("write the bare number, without a unit; {}", range.advice)
        }
        (Content::Whole(_) | Content::Number(_), Value::Name | Value::Text) => {
            "write it in quotes".into()
        }
        (_, Value::Name) => "use letters, digits, `-` and `_`, at most 64".into(),
        (Content::Number(_), Value::Count(_)) => "write a whole number".into(),
        (Content::Text(text), Value::Either(values)) => either_advice(text, values),
        (Content::Nothing, _) => "remove the key, or write its value after it".into(),
        _ => String::new(),
    };
    ledger.fault(node, message, advice);
    node.content = Content::Nothing;
}

/// Returns a number without leading zeros, such as 8 for 08.
fn bare(text: &str) -> String {
    let (sign, digits) =
        text.trim().strip_prefix('-').map_or(("", text.trim()), |rest| ("-", rest));
    let kept = digits.trim_start_matches('0');
    let zero = if kept.starts_with(|c: char| c.is_ascii_digit()) { "" } else { "0" };
    format!("{sign}{zero}{kept}")
}

/// Returns the advice for the word `text` where one of `values` was expected.
fn either_advice(text: &str, values: &[Value]) -> String {
    let words = values.iter().flat_map(|value| match value {
        Value::Word(words) => *words,
        _ => &[],
    });
    let advice = did_you_mean(text, words.copied());
    let is_text = |value: &Value| match value {
        Value::Either(values) => {
            values.iter().any(|value| matches!(value, Value::Name | Value::Text))
        }
        value => matches!(value, Value::Name | Value::Text),
    };
    let names = values.iter().any(|value| matches!(value, Value::List { of, .. } if is_text(of)));
    match advice.starts_with("did you mean") {
        false if names => format!("write a list: [{text}]"),
        _ => advice,
    }
}

fn same_kind(node: &Node, value: &Value) -> bool {
    match value {
        Value::Anything => true,
        Value::Nothing => node.content == Content::Nothing,
        Value::Switch => matches!(node.content, Content::Switch(_)),
        Value::Text | Value::Name | Value::Word(_) => node.text().is_some(),
        Value::Number(_) | Value::Count(_) => node.number().is_some(),
        Value::List { .. } => matches!(node.content, Content::List(_)),
        Value::Map(_) | Value::Variant(_) => matches!(node.content, Content::Map(_)),
        Value::Dependent { by, .. } => same_kind(node, by(node)),
        Value::Either(values) => values.iter().any(|value| same_kind(node, value)),
    }
}

/// Describes the expected value.
pub(super) fn describe(value: &Value) -> String {
    let names = |keys: &[Key]| -> Vec<String> {
        keys.iter().map(|key| format!("`{}`", key.name)).collect()
    };
    match value {
        Value::Anything => "any value".into(),
        Value::Nothing => "null".into(),
        Value::Switch => "`true` or `false`".into(),
        Value::Text => "text".into(),
        Value::Name => "a name".into(),
        Value::Word(words) => {
            one_of(&words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>())
        }
        Value::Number(range) | Value::Count(range) => in_range(range),
        Value::List { items, min, max, .. } if min == max => format!("a list of {min} {items}"),
        Value::List { items, min, max, .. } => format!("a list of {min} to {max} {items}"),
        Value::Map(keys) => format!("a map with the keys {}", names(keys).join(", ")),
        Value::Variant(keys) => format!("a map with one key, {}", one_of(&names(keys))),
        Value::Dependent { of, .. } => of.first().map_or(String::new(), |value| describe(value)),
        Value::Either(values) => one_of(&values.iter().map(describe).collect::<Vec<_>>()),
    }
}

fn in_range(range: &Range) -> String {
    if range.low == range.high {
        return format!("{} {}", range.what, range.low);
    }
    format!("{} from {} to {}", range.what, range.low, range.high)
}
