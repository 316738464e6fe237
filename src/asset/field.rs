//! Table of the keys of a type: meaning, reader, writer and check of each key.

use serde_json::{Map, Value as Json};

use super::node::Node;
use super::spec::Key;

/// Key of the files of a `T`.
pub(super) struct Field<T: 'static> {
    /// Name, kind of value, range and meaning, as shown by the strict check, the schema and the
    /// book.
    pub key: Key,
    /// Stores a value in a `T`, given the map that holds the key and the value's node; returns
    /// `None` if the value is faulty.
    pub read: fn(&Node, &Node, &mut T) -> Option<()>,
    /// Returns the value to write; `None` if the file omits the key.
    pub write: fn(&T) -> Option<Json>,
    /// Returns a message if the value, when set in code, cannot be used in computations.
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

/// Reads the keys present in a map into `value`; returns `None` if a required key is missing or a
/// value is faulty.
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

/// Stores a value in `place` unless it is faulty.
pub(super) fn set<V>(place: &mut V, value: Option<V>) -> Option<()> {
    *place = value?;
    Some(())
}

/// Writes a value as a map that [`read`] accepts.
pub(super) fn write<T>(fields: &[Field<T>], value: &T) -> Json {
    let name = |field: &Field<T>| field.key.name.to_owned();
    let pair = |field: &Field<T>| Some((name(field), (field.write)(value)?));
    Json::Object(fields.iter().filter_map(pair).collect::<Map<_, _>>())
}

/// Returns the keys whose values cannot be used in computations, with messages.
pub(super) fn faults<T>(
    fields: &[Field<T>],
    value: &T,
) -> impl Iterator<Item = (&'static str, &'static str)> {
    fields.iter().filter_map(|field| Some((field.key.name, (field.fault)(value)?)))
}
