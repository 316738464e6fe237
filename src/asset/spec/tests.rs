//! Tests of the tables of keys.

use super::*;
use crate::asset::blade::BLADE_TOOL;
use crate::asset::recording::RECORDING;
use crate::asset::saved::{PLAN_FILE, TRAJECTORY_FILE};
use crate::asset::{task::TASK, tool::TOOL, world::WORLD};

fn walk(value: &Value, visit: &mut impl FnMut(&Value)) {
    visit(value);
    match value {
        Value::List { of, .. } => walk(of, visit),
        Value::Map(keys) | Value::Variant(keys) => {
            keys.iter().for_each(|key| walk(&key.value, visit));
        }
        Value::Dependent { of, .. } => of.iter().for_each(|value| walk(value, visit)),
        Value::Either(values) => values.iter().for_each(|value| walk(value, visit)),
        _ => {}
    }
}

#[test]
fn every_key_is_explained_and_every_range_holds_something() {
    for root in [&TOOL, &BLADE_TOOL, &TASK, &PLAN_FILE, &TRAJECTORY_FILE, &RECORDING, &WORLD] {
        walk(root, &mut |value| match value {
            Value::Map(keys) | Value::Variant(keys) => {
                for key in *keys {
                    assert!(key.meaning.ends_with('.'), "{}", key.name);
                    let optional = key.meaning.to_lowercase().contains("default");
                    assert_eq!(optional, !key.required, "{} states its default", key.name);
                }
            }
            Value::Number(range) | Value::Count(range) => {
                assert!(range.low <= range.high, "{}", range.what);
            }
            Value::List { min, max, .. } => assert!(min <= max),
            _ => {}
        });
    }
}
