//! The words of the command line that stand for values, each with its line in `--help`.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::act::ProbeRule;
use crate::bench::{CrowdFamily, JointMethod, Layout, Sighting, TaskKind};
use crate::dataset::{Controlled, JointRule, LeverPreset, Preset, Solids};
use crate::effect::Outside;
use crate::report::PageView;
use crate::scene::Engine;
#[cfg(feature = "train")]
use crate::scene::LeverFeatures;
use crate::solve::Effort;
#[cfg(feature = "train")]
use crate::train::Exposure;

/// Words, what they stand for, and what that means.
pub type Words<T> = [(&'static str, T, &'static str)];

/// How hard to try.
pub static EFFORTS: [(&str, Effort, &str); 4] = [
    ("draft", Effort::Draft, "A first look"),
    ("standard", Effort::Standard, "Enough for most tasks"),
    ("thorough", Effort::Thorough, "Longer, by simulation, and told in finer shares"),
    ("exhaustive", Effort::Exhaustive, "As thorough, told in the finest shares"),
];

/// What to do where a model should not be trusted.
pub static OUTSIDE: [(&str, Outside, &str); 3] = [
    ("simulate", Outside::Simulate, "Simulate in the plane instead"),
    ("warn", Outside::Warn, "Predict and warn"),
    ("refuse", Outside::Refuse, "Give no prediction; exit code 6"),
];

/// What a page shows of the table.
pub static VIEWS: [(&str, PageView, &str); 2] = [
    ("2d", PageView::Above, "A drawing from above"),
    ("3d", PageView::Solid, "The same, and a scene to look at from all sides"),
];

/// Simulation engines.
pub static ENGINES: [(&str, Engine, &str); 3] = [
    ("planar", Engine::Planar, "Top-down, fast"),
    ("3d", Engine::Spatial, "Full 3-D"),
    (
        "3d-upright",
        Engine::Upright,
        "3-D, but nothing tips: the physics of the plane by other code",
    ),
];

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
#[cfg(feature = "train")]
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
#[cfg(feature = "train")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeverForm {
    /// A long short-term memory, told the whole at once.
    Memory,
    /// Propagation between the cuboids of body and drive, step by step.
    Parts,
}

/// Both.
#[cfg(feature = "train")]
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

/// What may be asked of joints where errors are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AskedJoints {
    /// Sets with these.
    Rule(JointRule),
    /// What a prediction on recordings is told of them.
    Told(JointMethod),
}

impl AskedJoints {
    /// For sets.
    pub fn rule(self) -> Option<JointRule> {
        match self {
            Self::Rule(rule) => Some(rule),
            Self::Told(_) => None,
        }
    }

    /// For recordings.
    pub fn told(self) -> Option<JointMethod> {
        match self {
            Self::Rule(_) => None,
            Self::Told(method) => Some(method),
        }
    }
}

/// Joints of sets, and what is told of them.
pub static ASKED_JOINTS: [(&str, AskedJoints, &str); 9] = [
    ("fixed", AskedJoints::Rule(JointRule::Fixed), "Sets whose neighbours are joined rigidly"),
    ("mixed", AskedJoints::Rule(JointRule::Mixed), "Sets with all types of joints"),
    ("given", AskedJoints::Told(JointMethod::True), "Recordings: as they are stated"),
    ("none", AskedJoints::Told(JointMethod::None), "Recordings: nothing is joined"),
    (
        "contacts",
        AskedJoints::Told(JointMethod::ContactsFixed),
        "Recordings: what touches is fixed",
    ),
    (
        "residuals",
        AskedJoints::Told(JointMethod::Residuals),
        "Recordings: by geometric residual tests",
    ),
    (
        "one-step",
        AskedJoints::Told(JointMethod::LastWindow),
        "Recordings: what the last window says alone",
    ),
    (
        "filter",
        AskedJoints::Told(JointMethod::Filter),
        "Recordings: as the hypothesis filter believes",
    ),
    (
        "believed",
        AskedJoints::Told(JointMethod::Regulator),
        "Recordings: as the regulated belief has it",
    ),
];

/// Ways to choose a push that is made only to learn something.
pub static PROBES: [(&str, ProbeRule, &str); 5] = [
    ("task", ProbeRule::Task, "Tells apart the samples in which different plans work"),
    ("information", ProbeRule::Information, "Tells most, whatever the task is"),
    ("random", ProbeRule::Random, "By chance"),
    ("uncertain", ProbeRule::Uncertain, "At the pair whose joint is least certain"),
    ("motion", ProbeRule::Motion, "Moves things farthest"),
];

/// Solids of a crowd.
pub static SOLIDS: [(&str, Solids, &str); 2] = [
    ("cylinders", Solids::Cylinders, "Cylinders alone"),
    ("any", Solids::Any, "Cylinders and cuboids"),
];

/// Families of crowds.
pub static FAMILIES: [(&str, CrowdFamily, &str); 2] = [
    ("sparse", CrowdFamily::Sparse, "Scattered objects, seven or eight strokes of a round hand"),
    ("dense", CrowdFamily::Dense, "Objects almost touching, one stroke into them"),
];

/// How well things are seen.
pub static SIGHTINGS: [(&str, Sighting, &str); 5] = [
    ("exact", Sighting::Exact, "True poses"),
    ("fine", Sighting::Fine, "1 mm and 0.5 degrees of noise"),
    ("coarse", Sighting::Coarse, "3 mm and 2 degrees of noise"),
    ("unmarked", Sighting::Unmarked, "Cylinders alone, true positions, no headings"),
    ("unmarked-fine", Sighting::UnmarkedFine, "Cylinders alone, 1 mm of noise, no headings"),
];

/// Set-ups in which only masses differ.
pub static CONTROLLED: [(&str, Controlled, &str); 2] = [
    ("rows", Controlled::Rows, "Three rows of three, every second cylinder somewhat aside"),
    ("wedges", Controlled::Wedges, "Three times one before the gap between two"),
];

/// Kinds of random tasks.
pub static KINDS: [(&str, TaskKind, &str); 8] = [
    ("reach", TaskKind::Reach, "Farther out than the end effector can go"),
    ("pull", TaskKind::Pull, "Towards the robot"),
    ("sweep", TaskKind::Sweep, "Sideways"),
    ("obstacle", TaskKind::Obstacle, "Around an obstacle"),
    ("heading", TaskKind::Heading, "A cuboid, to a place and a heading"),
    ("pair", TaskKind::Pair, "One of two joined objects"),
    (
        "gap",
        TaskKind::Gap,
        "Behind a gap that is too narrow: no plan can be right (only if asked for)",
    ),
    (
        "cluster",
        TaskKind::Cluster,
        "One of four that stand close, some of them joined (only if asked for)",
    ),
];

/// Where the cylinder of the tool benchmark starts.
pub static LAYOUTS: [(&str, Layout, &str); 2] = [
    ("grid", Layout::Grid, "On the reference's grid, where flat faces meet it nearly always"),
    ("scattered", Layout::Scattered, "Anywhere within its cell of that grid"),
];

/// How far the network's own rollout leads up to an example.
#[cfg(feature = "train")]
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

/// Reads one of these words.
pub fn words<T>(table: &'static Words<T>) -> impl TypedValueParser<Value = T>
where
    T: Clone + Send + Sync + 'static,
{
    let values = table.iter().map(|(word, _, meaning)| PossibleValue::new(*word).help(*meaning));
    PossibleValuesParser::new(values).try_map(|given| {
        let known = table.iter().find(|(word, ..)| *word == given);
        known.map(|(_, value, _)| value.clone()).ok_or_else(|| format!("`{given}` is not known"))
    })
}
