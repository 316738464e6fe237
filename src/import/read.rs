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
