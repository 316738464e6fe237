//! Conversion of a Python mapping to the text of a file, with the key of every line.
//!
//! Tasks and tools built in code thereby obey the same rules as files, and faults name keys instead
//! of lines.

use pushplan::files::Faults;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple};

use crate::errors;

/// Maximum nesting depth, beyond any file format; it also stops at a list that contains itself.
const DEEPEST: usize = 16;

/// Mapping as flow YAML, with the key of every line.
pub struct Text {
    text: String,
    keys: Vec<String>,
}

impl Text {
    /// Converts a mapping of numbers, strings, lists, arrays and mappings.
    pub fn of(mapping: &Bound<'_, PyAny>) -> PyResult<Self> {
        let mut text = Self { text: String::new(), keys: vec![String::new()] };
        text.value(mapping, "", 0)?;
        Ok(text)
    }

    /// Reads the text with `parse`, which takes the text and its name.
    pub fn read<T>(
        &self,
        py: Python<'_>,
        name: &str,
        parse: impl Fn(&str, &str) -> Result<T, Faults>,
    ) -> PyResult<T> {
        parse(&self.text, name).map_err(|faults| errors::files(py, &faults, Some(&self.keys)))
    }

    /// Begins a line that belongs to `key`.
    fn line(&mut self, key: &str) {
        self.text.push_str("\n ");
        self.keys.push(key.to_owned());
    }

    fn value(&mut self, value: &Bound<'_, PyAny>, key: &str, depth: usize) -> PyResult<()> {
        let place = if key.is_empty() { String::new() } else { format!("{key}: ") };
        if depth > DEEPEST {
            return Err(PyValueError::new_err(format!(
                "{place}lists and mappings are nested deeper than {DEEPEST} levels"
            )));
        }
        if value.is_none() {
            self.text.push_str("null");
        } else if let Ok(switch) = value.cast::<PyBool>() {
            self.text.push_str(if switch.is_true() { "true" } else { "false" });
        } else if let Ok(words) = value.cast::<PyString>() {
            self.quoted(words.to_str()?)?;
        } else if value.is_instance_of::<PyFloat>() {
            self.number(value.extract()?);
        } else if value.is_instance_of::<PyInt>() {
            self.text.push_str(value.str()?.to_str()?);
        } else if let Ok(mapping) = value.cast::<PyMapping>() {
            self.mapping(mapping, key, depth)?;
        } else if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
            self.list(value, key, depth)?;
        } else if value.hasattr("tolist")? {
            // Arrays and numbers of NumPy.
            self.value(&value.call_method0("tolist")?, key, depth + 1)?;
        } else {
            let kind = value.get_type().name()?;
            let message =
                format!("{place}expected numbers, strings, lists or mappings, found {kind}");
            return Err(PyTypeError::new_err(message));
        }
        Ok(())
    }

    fn quoted(&mut self, words: &str) -> PyResult<()> {
        // JSON strings are also valid in YAML.
        let words = serde_json::to_string(words);
        self.text += &words.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(())
    }

    fn number(&mut self, number: f64) {
        // The reader reports faults for numbers that are not finite.
        self.text += &match number {
            number if number.is_finite() => format!("{number:?}"),
            number if number.is_nan() => ".nan".to_owned(),
            number if number > 0.0 => ".inf".to_owned(),
            _ => "-.inf".to_owned(),
        };
    }

    fn mapping(&mut self, mapping: &Bound<'_, PyMapping>, key: &str, depth: usize) -> PyResult<()> {
        self.text.push('{');
        for item in mapping.items()?.iter() {
            let (name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
            let Ok(name) = name.cast::<PyString>() else {
                let message = format!("{key}: keys must be strings, found {}", name.repr()?);
                return Err(PyTypeError::new_err(message));
            };
            let name = name.to_str()?;
            let dot = if key.is_empty() { "" } else { "." };
            let own = format!("{key}{dot}{name}");
            self.line(&own);
            self.quoted(name)?;
            self.text.push_str(": ");
            self.value(&value, &own, depth + 1)?;
            self.text.push(',');
        }
        self.line(key);
        self.text.push('}');
        Ok(())
    }

    fn list(&mut self, list: &Bound<'_, PyAny>, key: &str, depth: usize) -> PyResult<()> {
        self.text.push('[');
        for (k, item) in list.try_iter()?.enumerate() {
            let own = format!("{key}[{k}]");
            self.line(&own);
            self.value(&item?, &own, depth + 1)?;
            self.text.push(',');
        }
        self.line(key);
        self.text.push(']');
        Ok(())
    }
}
