//! Parameters as named tensors of a safetensors file, shared by weights and checkpoints.

use std::collections::HashMap;

use safetensors::{Dtype, SafeTensorError, SafeTensors, tensor::TensorView};
use thiserror::Error;

use super::Parameters;

/// A parameter that is missing or unusable.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("the parameter `{name}` {fault}")]
pub struct ParameterError {
    /// Name of the parameter.
    pub name: String,
    /// Description of the fault.
    pub fault: &'static str,
}

/// Encodes groups of parameters as the bytes of a file.
///
/// Every group has the names and shapes of `layout` under its prefix. The metadata have a single
/// entry, `text` under `key`, because the order of several would differ from run to run.
///
/// # Errors
/// Returns an error if a parameter's length does not fit its shape.
pub fn encode_parameters(
    layout: &[(&str, Vec<usize>)],
    groups: &[(&str, &Parameters)],
    (key, text): (&str, String),
) -> Result<Vec<u8>, SafeTensorError> {
    let mut raw: Vec<(String, Vec<usize>, Vec<u8>)> = Vec::new();
    for (prefix, parameters) in groups {
        for (name, shape) in layout {
            let values = parameters.values.get(*name).map_or(&[][..], Vec::as_slice);
            let bytes = values.iter().flat_map(|x| x.to_le_bytes()).collect();
            raw.push((format!("{prefix}{name}"), shape.clone(), bytes));
        }
    }
    let views = raw
        .iter()
        .map(|(name, shape, bytes)| {
            Ok((name.as_str(), TensorView::new(Dtype::F32, shape.clone(), bytes)?))
        })
        .collect::<Result<Vec<_>, SafeTensorError>>()?;
    safetensors::serialize(views, Some(HashMap::from([(key.to_owned(), text)])))
}

/// Reads the group of parameters under `prefix`. Each must be present, of the right shape and
/// finite.
///
/// # Errors
/// Returns [`ParameterError`] for the first parameter that fails one of these checks.
pub fn decode_parameters(
    file: &SafeTensors<'_>,
    layout: &[(&str, Vec<usize>)],
    prefix: &str,
) -> Result<Parameters, ParameterError> {
    let mut parameters = Parameters::default();
    for (name, shape) in layout {
        let key = format!("{prefix}{name}");
        let wrong = |fault| ParameterError { name: key.clone(), fault };
        let view = file.tensor(&key).map_err(|_| wrong("is missing"))?;
        if view.dtype() != Dtype::F32 || view.shape() != *shape {
            return Err(wrong("has a wrong type or shape"));
        }
        let values: Vec<f32> = view
            .data()
            .chunks_exact(4)
            .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
            .collect();
        if values.iter().any(|x| !x.is_finite()) {
            return Err(wrong("holds a number that is not finite"));
        }
        parameters.values.insert((*name).to_owned(), values);
    }
    Ok(parameters)
}

/// Returns the text under `key` of a file's metadata.
///
/// # Errors
/// Returns an error if the bytes are no safetensors file.
pub fn file_metadata(bytes: &[u8], key: &str) -> Result<Option<String>, SafeTensorError> {
    let (_, metadata) = SafeTensors::read_metadata(bytes)?;
    Ok(metadata.metadata().as_ref().and_then(|entries| entries.get(key)).cloned())
}
