//! The text form of a [`ModelSpec`]: writing and parsing.

use std::fmt;
use std::num::{NonZeroU8, NonZeroU16};
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use thiserror::Error;

use crate::scene::{Engine, FRAME_TRAVEL};

use super::{Assumptions, JointBelief, ModelKind, ModelPart, ModelSpec, Rate, Stride};

/// The reason why a text does not name an effect model.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum SpecError {
    /// Unknown kind.
    #[error(
        "`{found}` is not an effect model; use network, prior, planar, 3d, 3d-upright or still, \
         or a file that ends in .safetensors"
    )]
    Kind {
        /// The text in place of the kind.
        found: String,
    },
    /// A setting that this kind does not have.
    #[error("`{kind}` has no setting `{found}`; it takes {takes}")]
    Key {
        /// The kind.
        kind: &'static str,
        /// The text in place of the setting.
        found: String,
        /// Settings of the kind, each with an example.
        takes: &'static str,
    },
    /// A setting given twice.
    #[error("`{key}` is given twice")]
    Twice {
        /// Name of the setting.
        key: String,
    },
    /// An invalid value of a setting.
    #[error("`{key}={found}`: expected {expected}")]
    Value {
        /// Name of the setting.
        key: &'static str,
        /// The text in place of the value.
        found: String,
        /// Valid values.
        expected: &'static str,
    },
}

/// Concatenates the settings of a kind of model, for messages.
macro_rules! takes {
    ($own:literal) => {
        concat!($own, "joints=none|guessed|fixed, friction=70%, start=100um, up-to=2")
    };
}

/// Travel in a frame, millimetres.
const FRAME: f64 = 1e3 * FRAME_TRAVEL;

impl ModelKind {
    /// Returns the word that begins the text form.
    fn word(&self) -> &'static str {
        match self {
            Self::Network { .. } => "network",
            Self::Prior { .. } => "prior",
            Self::Simulated { engine: Engine::Planar, .. } => "planar",
            Self::Simulated { engine: Engine::Spatial, .. } => "3d",
            Self::Simulated { engine: Engine::Upright, .. } => "3d-upright",
            Self::Still => "still",
            Self::Custom(word) => word,
        }
    }

    fn of_word(word: &str) -> Option<Self> {
        let all =
            [Self::NETWORK, Self::PRIOR, Self::PLANAR, Self::SPATIAL, Self::UPRIGHT, Self::Still];
        all.into_iter().find(|kind| kind.word() == word)
    }

    fn takes(&self) -> &'static str {
        match self {
            Self::Network { .. } => takes!("weights=FILE, steps=2, frame=20mm, "),
            Self::Prior { .. } => takes!("frame=20mm, "),
            Self::Simulated { .. } => takes!("step=1/120, "),
            Self::Still | Self::Custom(_) => takes!(""),
        }
    }

    /// Sets a setting of this kind; returns `false` if this kind has no such setting.
    fn set(&mut self, key: &str, value: &str) -> Result<bool, SpecError> {
        match (self, key) {
            (Self::Network { weights, .. }, "weights") => {
                *weights = Some(unquoted(value).ok_or_else(|| SpecError::Value {
                    key: "weights",
                    found: value.to_owned(),
                    expected: "a file; if its name contains a comma, a bar, `>` or quotes, write \
                               it in double quotes and double the inner quotes",
                })?);
            }
            (Self::Network { steps, .. }, "steps") => {
                *steps =
                    Some(parsed("steps", value, "a number from 0 to 255", |v| v.parse().ok())?);
            }
            (Self::Network { stride, .. } | Self::Prior { stride }, "frame") => {
                let expected = "a multiple of 10mm, up to 2550mm";
                *stride = parsed("frame", value, expected, |value| {
                    let millimetres: f64 = value.strip_suffix("mm")?.parse().ok()?;
                    let frames = millimetres / FRAME;
                    let whole = frames.fract() == 0.0 && (1.0..=255.0).contains(&frames);
                    whole.then(|| NonZeroU8::new(frames as u8).map(Stride)).flatten()
                })?;
            }
            (Self::Simulated { rate, .. }, "step") => {
                *rate = parsed("step", value, "1/N seconds with N from 1 to 65535", |value| {
                    let rate: NonZeroU16 = value.strip_prefix("1/")?.parse().ok()?;
                    Some(Rate(rate))
                })?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

impl ModelPart {
    /// Sets a setting that all kinds have; returns `false` if there is no such setting.
    fn set(&mut self, key: &str, value: &str) -> Result<bool, SpecError> {
        let Assumptions { joints, friction, start } = &mut self.assumptions;
        match key {
            "joints" => {
                *joints = Some(parsed("joints", value, "none, guessed or fixed", |value| {
                    JointBelief::ALL.into_iter().find(|belief| belief.word() == value)
                })?);
            }
            "friction" => {
                let expected = "a percentage such as 70%, up to 65535%";
                *friction = Some(parsed("friction", value, expected, |value| {
                    value.strip_suffix('%')?.parse().ok()
                })?);
            }
            "start" => {
                let expected = "micrometres such as 100um, up to 65535um";
                *start = Some(parsed("start", value, expected, |value| {
                    value.strip_suffix("um")?.parse().ok()
                })?);
            }
            "up-to" => {
                let expected = "a number of objects";
                self.up_to = Some(parsed("up-to", value, expected, |value| value.parse().ok())?);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

impl JointBelief {
    const ALL: [Self; 3] = [Self::None, Self::Guessed, Self::Fixed];

    fn word(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Guessed => "guessed",
            Self::Fixed => "fixed",
        }
    }
}

impl fmt::Display for ModelSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, part) in self.parts().enumerate() {
            let bar = if k > 0 { "|" } else { "" };
            write!(f, "{bar}{part}")?;
        }
        Ok(())
    }
}

impl fmt::Display for ModelPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind.word())?;
        match &self.kind {
            ModelKind::Network { weights, steps, .. } => {
                if let Some(weights) = weights {
                    write!(f, ",weights={}", quoted(weights))?;
                }
                if let Some(steps) = steps {
                    write!(f, ",steps={steps}")?;
                }
            }
            ModelKind::Simulated { rate, .. } if *rate != Rate::DEFAULT => {
                write!(f, ",step=1/{}", rate.0)?;
            }
            _ => {}
        }
        match self.kind {
            ModelKind::Network { stride, .. } | ModelKind::Prior { stride }
                if stride != Stride::ONE =>
            {
                write!(f, ",frame={}mm", FRAME * f64::from(stride.0.get()))?;
            }
            _ => {}
        }
        let Assumptions { joints, friction, start } = self.assumptions;
        if let Some(joints) = joints {
            write!(f, ",joints={}", joints.word())?;
        }
        if let Some(percent) = friction {
            write!(f, ",friction={percent}%")?;
        }
        if let Some(micrometres) = start {
            write!(f, ",start={micrometres}um")?;
        }
        match self.up_to {
            Some(objects) => write!(f, ",up-to={objects}"),
            None => Ok(()),
        }
    }
}

impl FromStr for ModelSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let text = text.trim();
        let word = text.split([',', '|']).next().unwrap_or_default().trim();
        if text.ends_with(".safetensors") && ModelKind::of_word(word).is_none() {
            let weights = Some(text.to_owned());
            return Ok(ModelKind::Network { weights, steps: None, stride: Stride::ONE }.into());
        }
        let mut parts = split(text, '|').into_iter().map(part);
        let first = ModelSpec::from(parts.next().unwrap_or_else(|| part(""))?);
        parts.try_fold(first, |spec, part| Ok(spec.or(part?)))
    }
}

fn part(text: &str) -> Result<ModelPart, SpecError> {
    let mut fields = split(text, ',').into_iter();
    let word = fields.next().unwrap_or_default();
    let kind = ModelKind::of_word(word).ok_or_else(|| SpecError::Kind { found: word.into() })?;
    let mut part = ModelPart { kind, assumptions: Assumptions::default(), up_to: None };
    let mut known: Vec<&str> = Vec::new();
    for field in fields {
        let (key, value) = field.split_once('=').unwrap_or((field, ""));
        let (key, value) = (key.trim(), value.trim());
        if known.contains(&key) {
            return Err(SpecError::Twice { key: key.to_owned() });
        }
        known.push(key);
        if !part.kind.set(key, value)? && !part.set(key, value)? {
            let (kind, takes) = (part.kind.word(), part.kind.takes());
            return Err(SpecError::Key { kind, found: key.to_owned(), takes });
        }
    }
    Ok(part)
}

fn parsed<T>(
    key: &'static str,
    value: &str,
    expected: &'static str,
    parse: impl Fn(&str) -> Option<T>,
) -> Result<T, SpecError> {
    let found = || SpecError::Value { key, found: value.to_owned(), expected };
    parse(value).ok_or_else(found)
}

/// Splits a text at separators outside of quotes, and trims the pieces.
pub(super) fn split(text: &str, separator: char) -> Vec<&str> {
    let mut inside = false;
    let pieces = text.split(|c| {
        inside ^= c == '"';
        c == separator && !inside
    });
    pieces.map(str::trim).collect()
}

/// Quotes a text that is empty, contains a separator or a quote, or begins or ends with a space.
fn quoted(text: &str) -> String {
    let plain = !text.is_empty() && text.trim() == text && !text.contains([',', '|', '>', '"']);
    if plain { text.to_owned() } else { format!("\"{}\"", text.replace('"', "\"\"")) }
}

/// Undoes [`quoted`]; `None` if the quotes do not pair up.
fn unquoted(text: &str) -> Option<String> {
    let Some(rest) = text.strip_prefix('"') else {
        return (!text.is_empty() && !text.contains('"')).then(|| text.to_owned());
    };
    let inner = rest.strip_suffix('"')?;
    let bare = inner.replace("\"\"", "");
    (!bare.contains('"')).then(|| inner.replace("\"\"", "\""))
}

impl Serialize for ModelSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for ModelSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(de::Error::custom)
    }
}
