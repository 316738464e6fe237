//! Recognition and reading of a file.

use std::path::{Path, PathBuf};

use pushplan::asset::{Faults, read_text};

use super::diagnostic::Ledger;
use super::model::Model;
use super::spliced::{Spliced, document};
use super::xml::Source;
use super::{mesh, mjcf, urdf};
use crate::foreign::Files;

/// Language of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// MuJoCo's format.
    Mjcf,
    /// Robot description format of ROS.
    Urdf,
    /// Mesh in STL.
    Stl,
    /// Mesh in OBJ.
    Obj,
    /// Mesh in DAE (COLLADA).
    Dae,
}

impl Language {
    /// Returns the name of the language.
    pub fn name(self) -> &'static str {
        match self {
            Language::Mjcf => "MJCF",
            Language::Urdf => "URDF",
            Language::Stl => "STL",
            Language::Obj => "OBJ",
            Language::Dae => "DAE",
        }
    }
}

/// Options for reading files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// Folder that must contain all files named by the file; by default its own folder. Unless
    /// nothing may be assumed, meshes may also lie in the folders around it.
    pub root: Option<PathBuf>,
    /// Unit of an imported mesh file, metres; by default metres, or the unit that makes the mesh an
    /// object on a table.
    pub unit: Option<f64>,
    /// Whether nothing is assumed, so that what a file leaves open is a fault.
    pub strict: bool,
}

/// Reads an MJCF or URDF file, recognised by its root element, or a mesh, recognised by its
/// extension. Returns the model and its language.
///
/// # Errors
/// Returns all faults of the file, each with its place.
pub fn read(path: impl AsRef<Path>, reading: &Reading) -> Result<(Model, Language), Faults> {
    let path = path.as_ref();
    if let Some(language) = mesh::language(path) {
        return Ok((mesh::model(path, reading)?, language));
    }
    let (file, text) = read_text(path)?;
    let files = Files::of(path, reading.root.as_deref());
    parsed(&text, &file, &files, reading.strict)
}

/// Reads an MJCF or URDF text that names no other files; `file` is its name in faults.
///
/// # Errors
/// Returns all faults of the text, each with its place.
pub fn parse(text: &str, file: &str) -> Result<(Model, Language), Faults> {
    parsed(text, file, &Files::default(), false)
}

/// Reads a text that may name `files`. If it is read strictly, nothing is assumed.
pub(super) fn parsed(
    text: &str,
    file: &str,
    files: &Files,
    strict: bool,
) -> Result<(Model, Language), Faults> {
    let spliced = Spliced::read(text, file, files)?;
    let document = document(&spliced.text, file)?;
    let mut source = Source::new(&spliced, Ledger::new(file, &spliced.names(), strict));
    let root = document.root_element();
    let (model, language) = match root.tag_name().name() {
        "mujoco" => (mjcf::model(&mut source, root, files), Language::Mjcf),
        "robot" => (urdf::model(&mut source, root, files), Language::Urdf),
        other => {
            let message = format!("<{other}> is neither <mujoco> (MJCF) nor <robot> (URDF)");
            let advice = match other {
                "sdf" => "convert SDF to URDF or MJCF first",
                "mujocoinclude" => "give the file that includes this one",
                _ => "is this the right file?",
            };
            source.fault(root, message, advice);
            (None, Language::Mjcf)
        }
    };
    let names = source.ledger.files().to_vec();
    let (mut model, notes) = source.ledger.finish(model)?;
    model.files = names;
    model.notes = notes;
    model.strict = strict;
    Ok((model, language))
}
