//! Names of data and networks, each with its line in `--help`.

use crate::dataset::{JointRule, LeverPreset, Preset, Solids, Truth};
use crate::train::Exposure;

/// Families of training scenes.
pub static PRESETS: [(&str, Preset, &str); 5] = [
    ("tools", Preset::Tools, "One to three objects, sometimes obstacles, pushed by random tools"),
    ("sparse", Preset::Sparse, "Scattered objects, seven or eight strokes of a round hand"),
    ("sparse-line", Preset::SparseLine, "Scattered objects, one long stroke through them"),
    ("dense", Preset::Dense, "Objects almost touching, one stroke into them"),
    ("crowds", Preset::Crowds, "Crowds of all three kinds"),
];

/// Sources of the ground truth for pushes with tools.
pub static TRUTHS: [(&str, Truth, &str); 4] = [
    ("both", Truth::Both, "The 3-D engine in four of five episodes, else the planar one"),
    ("planar", Truth::Planar, "The planar engine"),
    ("3d", Truth::Spatial, "The 3-D engine"),
    ("mujoco", Truth::Mujoco, "MuJoCo, by the Python that PUSHPLAN_PYTHON names or `python3`"),
];

/// Families of lever-ups.
pub static LEVER_PRESETS: [(&str, LeverPreset, &str); 6] = [
    ("levers", LeverPreset::Fixed, "Polygons levered up by one motion, at any place"),
    ("levers-varied", LeverPreset::Varied, "The same by any motion, with any friction"),
    ("disc", LeverPreset::Disc, "A disc levered up at 100 places"),
    ("pcb", LeverPreset::Board, "A circuit board's outline levered up at any place"),
    ("hdd", LeverPreset::Drive, "Boards lifted or pried out of drives built of cuboids"),
    ("lying", LeverPreset::Lying, "Boxes and lying cylinders, alike from above"),
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
pub static DATA: [(&str, Data, &str); 11] = data();

/// Joints between near neighbours of a crowd.
pub static JOINTS: [(&str, JointRule, &str); 3] = [
    ("none", JointRule::None, "None"),
    ("fixed", JointRule::Fixed, "Some neighbours joined rigidly"),
    ("mixed", JointRule::Mixed, "Some neighbours joined by fixed, revolute and prismatic joints"),
];

const fn data() -> [(&'static str, Data, &'static str); 11] {
    let mut all = [("", Data::Levers(LeverPreset::Fixed), ""); 11];
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
    ("cylinders", Solids::Cylinders, "Cylinders alone"),
    ("any", Solids::Any, "Cylinders and cuboids"),
];

/// Distributions of the number of rollout frames before an example.
pub static EXPOSURES: [(&str, Exposure, &str); 3] = [
    ("pushforward", Exposure::Pushforward, "Any number of frames, each equally often"),
    (
        "scheduled",
        Exposure::Scheduled,
        "Scheduled sampling: each frame with a probability that rises from zero to one",
    ),
    (
        "multi-step",
        Exposure::MultiStep,
        "Every start is followed for all of the frames, and every one is an example",
    ),
];
