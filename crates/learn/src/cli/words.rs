//! Words for data and networks, each with its line in `--help`.

use pushplan::internals::scene::LeverFeatures;

use crate::dataset::{JointRule, LeverPreset, Preset, Solids};
use crate::train::Exposure;

/// Families of training scenes.
pub static PRESETS: [(&str, Preset, &str); 5] = [
    ("tools", Preset::Tools, "One to three objects, sometimes obstacles, pushed by random tools"),
    ("sparse", Preset::Sparse, "Scattered objects, seven or eight strokes of a round hand"),
    ("sparse-line", Preset::SparseLine, "Scattered objects, one long stroke through them"),
    ("dense", Preset::Dense, "Objects almost touching, one stroke into them"),
    ("mixed", Preset::Mixed, "All of the above: what the shipped weights are trained on"),
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

/// What a network of lever-ups is told of the shape.
pub static LEVER_FEATURES: [(&str, LeverFeatures, &str); 9] = [
    ("nothing", LeverFeatures::Nothing, "Nothing"),
    ("shape-context", LeverFeatures::ShapeContext, "Counts of outline points in rings and wedges"),
    ("corners", LeverFeatures::Corners, "Corners and centre of mass"),
    ("support", LeverFeatures::Support, "The support edge and the centre of mass"),
    ("shape", LeverFeatures::Shape, "All of the last two"),
    ("image", LeverFeatures::Image, "A mask from above, by convolutions"),
    ("image-code", LeverFeatures::ImageCode, "The same in the code of an autoencoder"),
    ("context-image", LeverFeatures::ContextImage, "The shape context, by convolutions"),
    ("depth", LeverFeatures::Depth, "Heights from above, by convolutions"),
];

/// What a network of lever-ups is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeverForm {
    /// A long short-term memory, told the whole at once.
    Memory,
    /// Propagation between the cuboids of body and drive, step by step.
    Parts,
}

/// Both.
pub static LEVER_FORMS: [(&str, LeverForm, &str); 2] = [
    ("memory", LeverForm::Memory, "A long short-term memory that is told the whole at once"),
    ("parts", LeverForm::Parts, "Propagation between cuboids that are near, step by step"),
];

/// What data can be made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Data {
    /// Pushes.
    Pushes(Preset),
    /// Lever-ups.
    Levers(LeverPreset),
}

/// All of them.
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

/// How far the network's own rollout leads up to an example.
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
