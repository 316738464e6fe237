//! The values of a text without their places, in the order of the text.

use serde_yaml::{Mapping, Value as Yaml};

use pushplan::asset::{Content, Node};

use super::apply::{Step, entry};

/// Returns the values of a node.
pub fn of(node: &Node) -> Yaml {
    match &node.content {
        Content::Nothing => Yaml::Null,
        Content::Switch(value) => Yaml::Bool(*value),
        Content::Whole(value) => match i64::try_from(*value) {
            Ok(value) => value.into(),
            Err(_) => (*value as f64).into(),
        },
        Content::Number(value) => (*value).into(),
        Content::Text(text) => text.as_str().into(),
        Content::List(items) => Yaml::Sequence(items.iter().map(of).collect()),
        Content::Map(pairs) => {
            pairs.iter().map(|(key, value)| (of(key), of(value))).collect::<Mapping>().into()
        }
    }
}

/// Sets or removes the value at the end of a path. Returns `false` if the path does not exist.
pub fn set(tree: &mut Yaml, path: &[Step], value: Option<&Yaml>) -> bool {
    let (Some((step, rest)), false) = (path.split_first(), path.is_empty()) else {
        if let Some(value) = value {
            *tree = value.clone();
        }
        return value.is_some();
    };
    match (entry(tree, step), value) {
        (Some(_), None) if rest.is_empty() => {
            match (step, tree) {
                (Step::Key(key), Yaml::Mapping(map)) => drop(map.shift_remove(key.as_str())),
                (Step::Item(index), Yaml::Sequence(list)) => drop(list.remove(*index)),
                _ => return false,
            }
            true
        }
        (Some(inner), _) => set(inner, rest, value),
        (None, None) => false,
        (None, Some(value)) => {
            let Some(value) = wrapped(value, rest) else { return false };
            match (step, tree) {
                (Step::Key(key), Yaml::Mapping(map)) => {
                    map.insert(key.as_str().into(), value);
                    true
                }
                (Step::Item(index), Yaml::Sequence(list)) if *index == list.len() => {
                    list.push(value);
                    true
                }
                // A key without a value becomes a map or a list as needed.
                (_, tree @ Yaml::Null) => match wrapped(&value, std::slice::from_ref(step)) {
                    Some(value) => {
                        *tree = value;
                        true
                    }
                    None => false,
                },
                _ => false,
            }
        }
    }
}

/// Returns a value within new maps and lists along `path`.
pub fn wrapped(value: &Yaml, path: &[Step]) -> Option<Yaml> {
    path.iter().rev().try_fold(value.clone(), |value, step| match step {
        Step::Key(key) => {
            Some([(key.as_str().into(), value)].into_iter().collect::<Mapping>().into())
        }
        Step::Item(0) => Some(Yaml::Sequence(vec![value])),
        Step::Item(_) => None,
    })
}

/// Returns `true` if two trees have equal values: 1 equals 1.0, and NaN equals NaN.
pub fn same(a: &Yaml, b: &Yaml) -> bool {
    match (a, b) {
        (Yaml::Number(a), Yaml::Number(b)) => match (a.as_f64(), b.as_f64()) {
            (Some(a), Some(b)) => a == b || a.is_nan() && b.is_nan(),
            _ => a == b,
        },
        (Yaml::Sequence(a), Yaml::Sequence(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
        }
        (Yaml::Mapping(a), Yaml::Mapping(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| same(a, b)))
        }
        _ => a == b,
    }
}
