//! Words for what is measured, each with its line in `--help`.

use pushplan_learn::dataset::{Controlled, JointRule};

use crate::bench::{CrowdFamily, JointMethod, Sighting, TaskKind};

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
