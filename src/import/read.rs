//! Recognising and reading a file.

use std::path::Path;

use roxmltree::Document;

use crate::asset::{Fault, Faults, Place, read_text};

use super::fault::Ledger;
use super::model::Model;
use super::xml::Source;
use super::{mjcf, urdf};

/// The language of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// MuJoCo's.
    Mjcf,
    /// That of ROS.
    Urdf,
}

impl Language {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Language::Mjcf => "MJCF",
            Language::Urdf => "URDF",
        }
    }
}

/// The most attributes of an element that are read: the time that takes grows with their square.
const MAX_ATTRIBUTES: usize = 256;

/// Where an element begins that has more attributes than [`MAX_ATTRIBUTES`].
fn crowded(text: &str) -> Option<Place> {
    let (mut begin, mut quote, mut count) = (None, None, 0);
    for (at, byte) in text.bytes().enumerate() {
        match (byte, quote) {
            (b'"' | b'\'', None) if begin.is_some() => quote = Some(byte),
            (_, Some(open)) if byte == open => quote = None,
            (_, Some(_)) => {}
            (b'<', None) => (begin, count) = (Some(at), 0),
            (b'>', None) => begin = None,
            (b'=', None) if begin.is_some() => count += 1,
            _ => {}
        }
        if count > MAX_ATTRIBUTES {
            let before = &text[..begin.unwrap_or_default()];
            let line = before.matches('\n').count() + 1;
            let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
            return Some(Place { line, column });
        }
    }
    None
}

/// Reads a file of MJCF or URDF; its root element says which. Gives the model and notes of what is
/// left out of it.
///
/// # Errors
/// All faults of the file, each with its place.
pub fn read(path: impl AsRef<Path>) -> Result<(Model, Language, Vec<String>), Faults> {
    let (file, text) = read_text(path.as_ref())?;
    parse(&text, &file)
}

/// Reads a text of MJCF or URDF; `file` names it in faults.
///
/// # Errors
/// All faults of the text, each with its place.
pub fn parse(text: &str, file: &str) -> Result<(Model, Language, Vec<String>), Faults> {
    if let Some(place) = crowded(text) {
        return Err(Fault {
            file: file.to_owned(),
            place: Some(place),
            message: format!("an element has more than {MAX_ATTRIBUTES} attributes"),
            advice: "MJCF and URDF elements have a few dozen at most; is this the right file?"
                .to_owned(),
        }
        .into());
    }
    let document = Document::parse(text).map_err(|error| {
        let at = error.pos();
        Fault {
            file: file.to_owned(),
            place: Some(Place { line: at.row as usize, column: at.col as usize }),
            message: format!("this is not XML: {error}"),
            advice: "MJCF and URDF are XML; other files are for `pushplan check`".to_owned(),
        }
    })?;
    let mut source = Source::new(text, Ledger::new(file));
    let root = document.root_element();
    let (model, language) = match root.tag_name().name() {
        "mujoco" => (mjcf::model(&mut source, root), Language::Mjcf),
        "robot" => (urdf::model(&mut source, root), Language::Urdf),
        other => {
            let message = format!("<{other}> is neither <mujoco> (MJCF) nor <robot> (URDF)");
            let advice = match other {
                "sdf" => "convert SDF to URDF or MJCF first",
                "mujocoinclude" => "name the file that includes this one",
                _ => "is this the right file?",
            };
            source.fault(root, message, advice);
            (None, Language::Mjcf)
        }
    };
    let (model, notes) = source.ledger.finish(model)?;
    Ok((model, language, notes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_with_hundreds_of_attributes_are_refused_at_once() {
        let text = |count: usize| {
            let all: String = (0..count).map(|k| format!(" a{k}='<=>'")).collect();
            format!("<mujoco>\n <geom{all}/>\n</mujoco>")
        };
        assert_eq!(crowded(&text(MAX_ATTRIBUTES)), None);
        assert_eq!(crowded(&text(100_000)), Some(Place { line: 2, column: 2 }));
    }
}
