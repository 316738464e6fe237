//! Compiler settings and options of a file.

use nalgebra::UnitQuaternion;
use roxmltree::Node;

use crate::Language;
use crate::turns;
use crate::xml::Source;

use super::defaults::{Defaults, Lookup};

/// Interpretation of the numbers in a file.
#[derive(Clone, Debug)]
pub(super) struct Compiler {
    /// Whether angles are in degrees.
    pub degrees: bool,
    /// Axes of Euler angles.
    pub letters: [char; 3],
    /// Whether masses follow from geoms even if a body states a mass; `None`: only if it states
    /// none.
    pub from_geoms: Option<bool>,
    /// Range of the groups of geoms that have mass, for bodies that state no mass.
    pub groups: [f64; 2],
    /// Folder of meshes, and folder of all assets, which applies if the first is not stated.
    pub meshes: Option<String>,
    pub assets: String,
    /// Whether stated ranges limit joints.
    pub limited: bool,
    /// Whether primitives are fitted to the bounding box of a mesh instead of its inertia.
    pub bounding: bool,
    /// Whether folders are stripped from file names.
    pub strip: bool,
    /// Whether the volume of a mesh is its enclosed volume, as set by an old attribute.
    pub exact: bool,
}

impl Default for Compiler {
    fn default() -> Self {
        Self {
            degrees: true,
            letters: ['x', 'y', 'z'],
            from_geoms: None,
            groups: [0.0, 5.0],
            meshes: None,
            assets: String::new(),
            limited: true,
            bounding: false,
            strip: false,
            exact: false,
        }
    }
}

impl Compiler {
    /// Reads a `compiler` element.
    pub fn read<'a>(&mut self, source: &mut Source<'a>, node: Node<'a, 'a>) {
        source.judge(Language::Mjcf, "compiler", node, |name| node.attribute_node(name));
        for attribute in node.attributes() {
            let (name, value) = (attribute.name(), attribute.value());
            let mut refuse = |advice: &str| {
                let message = format!("the compiler's {name}=\"{value}\" is not supported");
                source.fault_of(attribute, message, advice);
            };
            match (name, value) {
                ("angle", "degree") => self.degrees = true,
                ("angle", "radian") => self.degrees = false,
                ("eulerseq", _) => match letters(value) {
                    Some(letters) => self.letters = letters,
                    None => refuse("write three of the letters x, y, z, X, Y, Z"),
                },
                ("inertiafromgeom", "true") => self.from_geoms = Some(true),
                ("inertiafromgeom", "false") => self.from_geoms = Some(false),
                ("inertiafromgeom", "auto") => self.from_geoms = None,
                ("inertiagrouprange", _) => {
                    if let Some(groups) = source.numbers(attribute) {
                        self.groups = groups;
                    }
                }
                ("assetdir", folder) => folder.clone_into(&mut self.assets),
                ("meshdir", folder) => self.meshes = Some(folder.to_owned()),
                ("autolimits", word) => self.limited = word == "true",
                ("fitaabb", word) => self.bounding = word == "true",
                ("strippath", word) => self.strip = word == "true",
                ("exactmeshinertia", word) => self.exact = word == "true",
                ("angle" | "inertiafromgeom", _) => refuse("correct it, or remove it"),
                // Judged by the table.
                _ => {}
            }
        }
    }

    /// Converts an angle of the file to radians.
    pub fn angle(&self, value: f64) -> f64 {
        if self.degrees { value.to_radians() } else { value }
    }

    /// Returns the rotation that an element states; `None` with a fault if it is invalid.
    pub fn turn<'a>(
        &self,
        source: &mut Source<'a>,
        defaults: &Defaults<'a>,
        element: Lookup<'a, '_>,
    ) -> Option<UnitQuaternion<f64>> {
        let mut turn = UnitQuaternion::identity();
        for name in ["quat", "axisangle", "euler", "xyaxes", "zaxis"] {
            let Some(attribute) = defaults.find(element, name) else { continue };
            let found = match name {
                "quat" => turns::quaternion(source.numbers(attribute)?),
                "axisangle" => {
                    let [x, y, z, angle] = source.numbers(attribute)?;
                    turns::about([x, y, z], self.angle(angle))
                }
                "euler" => {
                    let angles: [f64; 3] = source.numbers(attribute)?;
                    Some(turns::euler(angles.map(|angle| self.angle(angle)), self.letters))
                }
                "xyaxes" => turns::axes(source.numbers(attribute)?),
                _ => turns::z_axis(source.numbers(attribute)?),
            };
            let Some(found) = found else {
                let message = format!("`{name}` is not a valid rotation: an axis has length zero");
                source.fault_of(attribute, message, "correct its numbers");
                return None;
            };
            turn = found;
            // A rotation of the element itself takes precedence over one of its class, of any kind.
            if element.node.attribute_node(name).is_some() {
                break;
            }
        }
        Some(turn)
    }
}

fn letters(value: &str) -> Option<[char; 3]> {
    let letters: [char; 3] = value.chars().collect::<Vec<_>>().try_into().ok()?;
    letters.iter().all(|letter| "xyzXYZ".contains(*letter)).then_some(letters)
}
