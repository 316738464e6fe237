//! Names of measured values, each with its line in `--help`.

use pushplan::internals::scene::LeverFeatures;
use pushplan_learn::dataset::Controlled;

use crate::bench::{CrowdFamily, JointMethod, Sighting, TaskKind};
use crate::image::ImageFeatures;

/// Assumptions about joints for the remaining motion.
pub static JOINT_METHODS: [(&str, JointMethod, &str); 7] = [
    ("given", JointMethod::True, "As they are stated"),
    ("none", JointMethod::None, "Nothing is joined"),
    ("contacts", JointMethod::ContactsFixed, "What touches is fixed"),
    ("residuals", JointMethod::Residuals, "By geometric residual tests"),
    ("one-step", JointMethod::LastWindow, "What the last window says alone"),
    ("filter", JointMethod::Filter, "As the hypothesis filter believes"),
    ("believed", JointMethod::Regulator, "As the regulated belief has it"),
];

/// Families of crowds.
pub static FAMILIES: [(&str, CrowdFamily, &str); 2] = [
    ("sparse", CrowdFamily::Sparse, "Scattered objects, seven or eight strokes of a round hand"),
    ("dense", CrowdFamily::Dense, "Objects almost touching, one stroke into them"),
];

/// Qualities of observations.
pub static SIGHTINGS: [(&str, Sighting, &str); 5] = [
    ("exact", Sighting::Exact, "True poses"),
    ("fine", Sighting::Fine, "1 mm and 0.5 degrees of noise"),
    ("coarse", Sighting::Coarse, "3 mm and 2 degrees of noise"),
    ("unmarked", Sighting::Unmarked, "Cylinders alone, true positions, no headings"),
    ("unmarked-fine", Sighting::UnmarkedFine, "Cylinders alone, 1 mm of noise, no headings"),
];

/// Setups that differ only in masses.
pub static CONTROLLED: [(&str, Controlled, &str); 2] = [
    ("rows", Controlled::Rows, "Three rows of three, every second cylinder somewhat aside"),
    ("wedges", Controlled::Wedges, "Three times one before the gap between two"),
];

/// Kinds of random tasks, and a name for the everyday kinds.
pub static KINDS: [(&str, &[TaskKind], &str); 21] = [
    ("reach", &[TaskKind::Reach], "Farther out than the end effector can go"),
    ("pull", &[TaskKind::Pull], "Towards the robot"),
    ("sweep", &[TaskKind::Sweep], "Sideways"),
    ("obstacle", &[TaskKind::Obstacle], "Around an obstacle"),
    ("heading", &[TaskKind::Heading], "A cuboid, to a place and a heading"),
    ("pair", &[TaskKind::Pair], "One of two joined objects"),
    (
        "gap",
        &[TaskKind::Gap],
        "Behind a gap that is too narrow: no plan can be right (only on request)",
    ),
    (
        "cluster",
        &[TaskKind::Cluster],
        "One of four close together, some of them joined (only on request)",
    ),
    ("everyday", &TaskKind::EVERYDAY, "All that follow (only on request, as each of them)"),
    ("door", &[TaskKind::Door], "A door on its hinge"),
    ("drawer", &[TaskKind::Drawer], "A drawer, in walls or in a free cabinet"),
    ("compound", &[TaskKind::Compound], "A thing of several solids, to a place and a heading"),
    ("turn", &[TaskKind::Turn], "To a heading alone"),
    ("region", &[TaskKind::Region], "Into a region"),
    ("relative", &[TaskKind::Relative], "Beside another object"),
    ("two-goals", &[TaskKind::TwoGoals], "Two objects, each to its place"),
    ("three-goals", &[TaskKind::ThreeGoals], "Three objects, each to its place"),
    ("two-tools", &[TaskKind::TwoTools], "Two objects that need different tools"),
    ("one-aside", &[TaskKind::OneAside], "Something stands in the way"),
    ("two-aside", &[TaskKind::TwoAside], "Two things stand in the way"),
    ("three-aside", &[TaskKind::ThreeAside], "Three things stand in the way"),
];

/// Features of the shape for a network of lever-ups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeFeatures {
    /// A fixed number of features.
    Numbers(LeverFeatures),
    /// An image, by convolutions.
    Image(ImageFeatures),
}

/// Names of all features.
pub static LEVER_FEATURES: [(&str, ShapeFeatures, &str); 9] = [
    ("nothing", ShapeFeatures::Numbers(LeverFeatures::Nothing), "Nothing"),
    (
        "shape-context",
        ShapeFeatures::Numbers(LeverFeatures::ShapeContext),
        "Counts of outline points in rings and wedges",
    ),
    ("corners", ShapeFeatures::Numbers(LeverFeatures::Corners), "Corners and centre of mass"),
    (
        "support",
        ShapeFeatures::Numbers(LeverFeatures::Support),
        "The support edge and the centre of mass",
    ),
    ("shape", ShapeFeatures::Numbers(LeverFeatures::Shape), "All of the last two"),
    ("image", ShapeFeatures::Image(ImageFeatures::Image), "A mask from above, by convolutions"),
    (
        "image-code",
        ShapeFeatures::Image(ImageFeatures::ImageCode),
        "The same in the code of an autoencoder",
    ),
    (
        "context-image",
        ShapeFeatures::Image(ImageFeatures::ContextImage),
        "The shape context, by convolutions",
    ),
    ("depth", ShapeFeatures::Image(ImageFeatures::Depth), "Heights from above, by convolutions"),
];
