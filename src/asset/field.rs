//! One entry per key of a type: what it holds, how it is read and written, and which values are faults.

use serde_json::{Map, Value as Json};

use super::node::Node;
use super::spec::Key;

/// A key of the files of a `T`.
pub(super) struct Field<T: 'static> {
    /// Name, kind of value, range and meaning: what the strict check, the schema and the book show.
    pub key: Key,
    /// Puts a value into a `T`, from the map that holds the key and the value's node; `None` if it is
    /// faulty.
    pub read: fn(&Node, &Node, &mut T) -> Option<()>,
    /// Value of the key in a file; `None` where a file does without.
    pub write: fn(&T) -> Option<Json>,
    /// Message on a value, set in code, that no computation can use.
    pub fault: fn(&T) -> Option<&'static str>,
}

/// Returns the keys of a table.
pub(super) const fn keys<T, const N: usize>(fields: &[Field<T>; N]) -> [Key; N] {
    let mut keys = [fields[0].key; N];
    let mut k = 1;
    while k < N {
        keys[k] = fields[k].key;
        k += 1;
    }
    keys
}

/// Reads the keys that a map has into `value`; `None` if a required one is missing, or one is faulty.
pub(super) fn read<T>(fields: &[Field<T>], map: &Node, mut value: T) -> Option<T> {
    for field in fields {
        match map.get(field.key.name) {
            Some(node) => (field.read)(map, node, &mut value)?,
            None if field.key.required => return None,
            None => {}
        }
    }
    Some(value)
}

/// Puts a value, unless it is faulty, into its place.
pub(super) fn set<V>(place: &mut V, value: Option<V>) -> Option<()> {
    *place = value?;
    Some(())
}

/// Writes a value as the map that [`read`] takes.
pub(super) fn write<T>(fields: &[Field<T>], value: &T) -> Json {
    let name = |field: &Field<T>| field.key.name.to_owned();
    let pair = |field: &Field<T>| Some((name(field), (field.write)(value)?));
    Json::Object(fields.iter().filter_map(pair).collect::<Map<_, _>>())
}

/// Returns the first key whose value no computation can use, with the message.
pub(super) fn fault<T>(fields: &[Field<T>], value: &T) -> Option<(&'static str, &'static str)> {
    fields.iter().find_map(|field| Some((field.key.name, (field.fault)(value)?)))
}
