//! Names of data and networks, each with its line in `--help`.

use crate::dataset::{JointRule, LeverPreset, Preset, Solids, Truth};

/// Families of training scenes.
pub static PRESETS: [(&str, Preset, &str); 6] = [
    ("tools", Preset::Tools, "1 to 3 objects, sometimes obstacles, pushed by random tools"),
    ("placed", Preset::Placed, "The same tables, one push as a planner places it"),
    ("sparse", Preset::Sparse, "Scattered objects, seven or eight strokes of a round hand"),
    ("sparse-line", Preset::SparseLine, "Scattered objects, one long stroke through them"),
    ("dense", Preset::Dense, "Objects almost touching, one stroke into them"),
    ("crowds", Preset::Crowds, "Crowds of all three kinds"),
];

/// Sources of the ground truth for pushes with tools.
pub static TRUTHS: [(&str, Truth, &str); 4] = [
    ("both", Truth::Both, "3-D engine in four of five episodes, otherwise 2-D engine"),
    ("planar", Truth::Planar, "2-D engine"),
    ("3d", Truth::Spatial, "3-D engine"),
    ("mujoco", Truth::Mujoco, "MuJoCo, run by PUSHPLAN_PYTHON or `python3`"),
];

/// Families of lever-ups.
pub static LEVER_PRESETS: [(&str, LeverPreset, &str); 6] = [
    ("levers", LeverPreset::Fixed, "Polygons, one fixed motion, random lever points"),
    ("levers-varied", LeverPreset::Varied, "Polygons, random motions, frictions and lever points"),
    ("disc", LeverPreset::Disc, "Disc, 100 lever points"),
    ("pcb", LeverPreset::Board, "Outline of a circuit board, random lever points"),
    ("hdd", LeverPreset::Drive, "Boards levered out of hard disk drives built from cuboids"),
    ("lying", LeverPreset::Lying, "Boxes and lying cylinders with the same outline from above"),
];

/// Kinds of training data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Data {
    /// Pushes with the hand or tools.
    Pushes(Preset),
    /// Lever-ups of plates.
    Levers(LeverPreset),
}

/// Names of all data.
pub static DATA: [(&str, Data, &str); 12] = data();

/// Joints between near neighbours of a crowd.
pub static JOINTS: [(&str, JointRule, &str); 3] = [
    ("none", JointRule::None, "No joints"),
    ("fixed", JointRule::Fixed, "Fixed joints between some neighbours"),
    ("mixed", JointRule::Mixed, "Fixed, revolute and prismatic joints between some neighbours"),
];

const fn data() -> [(&'static str, Data, &'static str); 12] {
    let mut all = [("", Data::Levers(LeverPreset::Fixed), ""); 12];
    let mut k = 0;
    while k < all.len() {
        all[k] = if k < PRESETS.len() {
            let (word, preset, meaning) = PRESETS[k];
            (word, Data::Pushes(preset), meaning)
        } else {
            let (word, preset, meaning) = LEVER_PRESETS[k - PRESETS.len()];
            (word, Data::Levers(preset), meaning)
        };
        k += 1;
    }
    all
}

/// Solids of a crowd.
pub static SOLIDS: [(&str, Solids, &str); 2] = [
    ("cylinders", Solids::Cylinders, "Cylinders only"),
    ("any", Solids::Any, "Cylinders and cuboids"),
];
