//! Weights files: the parameters of a network with everything needed to use and to judge them.
//!
//! A weights file is a safetensors file with one JSON text in its metadata: the format number, a
//! checksum over the card and all tensors, and the card. The [`Card`] type and the key of that text
//! identify the network. Reading checks every name, shape and number, because loading into an empty
//! map must never look like success.

use std::fmt;
use std::path::Path;

use safetensors::SafeTensors;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::checksum::{checksum, extend};
use crate::plain_file;

use super::{
    Config, Normaliser, Parameters, Statistics, Tables,
    normaliser::MIN_DEVIATION,
    parameters::Layout,
    tensors::{ParameterError, decode_parameters, encode_parameters, file_metadata},
};

/// Maximum magnitude of a parameter, a mean or a deviation. Trained networks stay below 4; far
/// beyond the limit, products in single precision overflow.
const LARGEST: f32 = 1e3;

/// Description and provenance of a network's weights.
pub trait Card: Clone + Serialize + DeserializeOwned {
    /// Key of the card in the file's metadata, which identifies the network.
    const KEY: &'static str;

    /// Version of the feature layout and file format; files of other versions are refused.
    const FORMAT: u32;

    /// Checks that sizes and scales are possible for a network; called before [`Card::layout`].
    ///
    /// # Errors
    /// [`WeightsError`] for the first that is not.
    fn check(&self) -> Result<(), WeightsError>;

    /// Returns the names and shapes of all parameters.
    fn layout(&self) -> Layout;
}

/// A card and its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights<C> {
    /// Description of the weights.
    pub card: C,
    /// Parameter values.
    pub parameters: Parameters,
}

/// Reason why a weights file cannot be used.
#[derive(Error)]
pub enum WeightsError {
    /// A file that cannot be read.
    #[error("cannot read the file: {0}")]
    Unreadable(#[from] std::io::Error),
    /// A file that is not a safetensors file.
    #[error("not a weights file: {0}")]
    Format(#[from] safetensors::SafeTensorError),
    /// A safetensors file of another program or another network.
    #[error("a safetensors file, but not one of this network: its metadata have no `{key}` entry")]
    Foreign {
        /// Key of this network.
        key: &'static str,
    },
    /// A card that cannot be read.
    #[error("the weights file's card is damaged: {0}")]
    Card(#[from] serde_json::Error),
    /// A file of another format version.
    #[error("the weights file has format {found}, this program reads {read}; train again")]
    Version {
        /// Format number found.
        found: u32,
        /// Format number that this program reads.
        read: u32,
    },
    /// A size that no network has.
    #[error("the weights file describes an impossible network: width {width}, {steps} steps")]
    Size {
        /// Width found.
        width: usize,
        /// Propagation steps found.
        steps: usize,
    },
    /// Bytes that differ from those written.
    #[error(
        "the weights file is damaged: its checksum is {found}, but was {written} when it was written"
    )]
    Checksum {
        /// Checksum in the file.
        written: String,
        /// Checksum of the bytes read.
        found: String,
    },
    /// A number of the card or a parameter that no sound network has.
    #[error("the weights file holds an impossible value: {name} is {value}, {expected} is sound")]
    Value {
        /// Name of the number.
        name: String,
        /// Value of the number.
        value: f64,
        /// Sound range.
        expected: &'static str,
    },
    /// A parameter that is missing, of a wrong shape or not finite.
    #[error("the weights file is damaged: {0}")]
    Parameter(#[from] ParameterError),
}

/// Prints the text of [`Display`](fmt::Display), which is readable when it leaves `main`.
impl fmt::Debug for WeightsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// Contents of the metadata text.
#[derive(Serialize, Deserialize)]
struct Header<C> {
    format: u32,
    checksum: String,
    card: C,
}

/// The format number, read first because a header of another format may have other keys.
#[derive(Deserialize)]
struct FormatOnly {
    format: u32,
}

impl<C: Card> Weights<C> {
    /// Returns `true` if a file's bytes belong to this network, damaged or not.
    pub fn are_in(bytes: &[u8]) -> bool {
        file_metadata(bytes, C::KEY).is_ok_and(|text| text.is_some())
    }

    /// Returns the bytes of the file; equal weights give equal bytes.
    ///
    /// # Errors
    /// If a parameter's length does not fit its shape.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WeightsError> {
        let (checksum, card) = (self.checksum()?, self.card.clone());
        let header = serde_json::to_string(&Header { format: C::FORMAT, checksum, card })?;
        let groups = [("", &self.parameters)];
        Ok(encode_parameters(&self.card.layout(), &groups, (C::KEY, header))?)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`WeightsError`] if it cannot be read or is not a sound weights file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, WeightsError> {
        Self::from_bytes(&plain_file::read(path.as_ref())?)
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// [`WeightsError`] if they are not a complete, sound and undamaged weights file of this
    /// network and version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, WeightsError> {
        let text = file_metadata(bytes, C::KEY)?.ok_or(WeightsError::Foreign { key: C::KEY })?;
        let FormatOnly { format: found } = serde_json::from_str(&text)?;
        if found != C::FORMAT {
            return Err(WeightsError::Version { found, read: C::FORMAT });
        }
        let Header::<C> { checksum: written, card, .. } = serde_json::from_str(&text)?;
        card.check()?;
        let file = SafeTensors::deserialize(bytes)?;
        let parameters = decode_parameters(&file, &card.layout(), "")?;
        check_parameters(&parameters)?;
        let weights = Self { card, parameters };
        let found = weights.checksum()?;
        if written != found {
            return Err(WeightsError::Checksum { written, found });
        }
        Ok(weights)
    }

    /// Returns the checksum of the card and of every tensor with its name, hexadecimal. It
    /// identifies the weights.
    ///
    /// # Errors
    /// If the card cannot be written.
    pub fn checksum(&self) -> Result<String, WeightsError> {
        let card = serde_json::to_string(&self.card)?;
        let sum = self.parameters.values.iter().fold(checksum(card.as_bytes()), |sum, tensor| {
            let (name, values) = tensor;
            values
                .iter()
                .fold(extend(sum, name.as_bytes()), |sum, value| extend(sum, &value.to_le_bytes()))
        });
        Ok(format!("{sum:016x}"))
    }
}

/// Checks that a propagation network can have this size.
///
/// # Errors
/// [`WeightsError::Size`] if not.
pub fn check_config(config: Config) -> Result<(), WeightsError> {
    let Config { width, steps } = config;
    if !(2..=4096).contains(&width) || width % 2 != 0 || !(1..=16).contains(&steps) {
        return Err(WeightsError::Size { width, steps });
    }
    Ok(())
}

/// Checks that a network without propagation can have this width and inputs of the sizes `sizes`.
///
/// # Errors
/// [`WeightsError::Size`] if not.
pub fn check_widths(width: usize, sizes: &[usize]) -> Result<(), WeightsError> {
    if sizes.iter().chain([&width]).any(|size| !(1..=4096).contains(size)) {
        return Err(WeightsError::Size { width, steps: 1 });
    }
    Ok(())
}

/// Checks that the scales of all `tables` of a graph are sound.
///
/// # Errors
/// The errors of [`check_scales`].
pub fn check_normaliser(normaliser: &Normaliser, tables: &Tables) -> Result<(), WeightsError> {
    let Tables { node, given, relation, .. } = tables;
    check_scales("normaliser.node_even", &normaliser.node_even, node[0])?;
    check_scales("normaliser.node_odd", &normaliser.node_odd, node[1])?;
    check_scales("normaliser.given_even", &normaliser.given_even, given[0])?;
    check_scales("normaliser.given_odd", &normaliser.given_odd, given[1])?;
    check_scales("normaliser.relation_even", &normaliser.relation_even, relation[0])?;
    check_scales("normaliser.relation_odd", &normaliser.relation_odd, relation[1])
}

/// Checks that scales are sound and have this number of columns.
///
/// # Errors
/// [`WeightsError::Parameter`] for another number of columns, [`WeightsError::Value`] for a scale
/// that no data have.
pub fn check_scales(name: &str, scales: &Statistics, columns: usize) -> Result<(), WeightsError> {
    if scales.mean.len() != columns || scales.deviation.len() != columns {
        let (name, fault) = (name.to_owned(), "has a wrong length");
        return Err(ParameterError { name, fault }.into());
    }
    let mean = scales.mean.iter().find(|x| !(-LARGEST..=LARGEST).contains(*x));
    if let Some(value) = mean {
        let (name, value) = (format!("{name}.mean"), f64::from(*value));
        return Err(WeightsError::Value { name, value, expected: "-1000 to 1000" });
    }
    let deviation = scales.deviation.iter().find(|x| !(MIN_DEVIATION..=LARGEST).contains(*x));
    if let Some(value) = deviation {
        let (name, value) = (format!("{name}.deviation"), f64::from(*value));
        return Err(WeightsError::Value { name, value, expected: "0.02 to 1000" });
    }
    Ok(())
}

fn check_parameters(parameters: &Parameters) -> Result<(), WeightsError> {
    for (name, values) in &parameters.values {
        if let Some(value) = values.iter().find(|value| value.abs() > LARGEST) {
            let (name, value) = (format!("`{name}`"), f64::from(*value));
            return Err(WeightsError::Value { name, value, expected: "up to 1000" });
        }
    }
    Ok(())
}
