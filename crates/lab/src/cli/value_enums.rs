//! Names of measured values, each with its line in `--help`.

use pushplan::internals::scene::LeverFeatures;
use pushplan_learn::dataset::Controlled;

use crate::bench::{CrowdFamily, JointMethod, Sighting, TaskKind};
use crate::image::ImageFeatures;

/// Assumptions about joints for the remaining motion.
pub static JOINT_METHODS: [(&str, JointMethod, &str); 7] = [
    ("given", JointMethod::True, "Stated joints"),
    ("none", JointMethod::None, "No joints"),
    ("contacts", JointMethod::ContactsFixed, "Fixed joints between touching objects"),
    ("residuals", JointMethod::Residuals, "Geometric residual tests"),
    ("one-step", JointMethod::LastWindow, "Evidence of the last window only"),
    ("filter", JointMethod::Filter, "Belief of the hypothesis filter"),
    ("believed", JointMethod::Regulator, "Belief of the filter with the regulator"),
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
    ("unmarked", Sighting::Unmarked, "Cylinders only, true positions, no headings"),
    ("unmarked-fine", Sighting::UnmarkedFine, "Cylinders only, 1 mm of noise, no headings"),
];

/// Setups that differ only in masses.
pub static CONTROLLED: [(&str, Controlled, &str); 2] = [
    ("rows", Controlled::Rows, "Three rows of three, every second cylinder slightly offset"),
    ("wedges", Controlled::Wedges, "Three groups: one cylinder in front of the gap of two"),
];

/// Kinds of random tasks, and a name for the everyday kinds.
pub static KINDS: [(&str, &[TaskKind], &str); 21] = [
    ("reach", &[TaskKind::Reach], "Object beyond the reach of the end effector"),
    ("pull", &[TaskKind::Pull], "Motion towards the robot"),
    ("sweep", &[TaskKind::Sweep], "Motion sideways"),
    ("obstacle", &[TaskKind::Obstacle], "Motion around an obstacle"),
    ("heading", &[TaskKind::Heading], "Cuboid with a goal position and heading"),
    ("pair", &[TaskKind::Pair], "One of two joined objects"),
    (
        "gap",
        &[TaskKind::Gap],
        "Goal behind a gap that is too narrow, without a solution (only on request)",
    ),
    (
        "cluster",
        &[TaskKind::Cluster],
        "One of four close objects, some of them joined (only on request)",
    ),
    ("everyday", &TaskKind::EVERYDAY, "All following kinds (only on request, like each of them)"),
    ("door", &[TaskKind::Door], "Door on a hinge"),
    ("drawer", &[TaskKind::Drawer], "Drawer, in walls or in a free cabinet"),
    ("compound", &[TaskKind::Compound], "Compound object with a goal position and heading"),
    ("turn", &[TaskKind::Turn], "Goal heading only"),
    ("region", &[TaskKind::Region], "Goal region"),
    ("relative", &[TaskKind::Relative], "Goal relative to another object"),
    ("two-goals", &[TaskKind::TwoGoals], "Two objects with a goal each"),
    ("three-goals", &[TaskKind::ThreeGoals], "Three objects with a goal each"),
    ("two-tools", &[TaskKind::TwoTools], "Two objects that need different tools"),
    ("one-aside", &[TaskKind::OneAside], "One obstructing object"),
    ("two-aside", &[TaskKind::TwoAside], "Two obstructing objects"),
    ("three-aside", &[TaskKind::ThreeAside], "Three obstructing objects"),
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
    ("nothing", ShapeFeatures::Numbers(LeverFeatures::Nothing), "No features"),
    (
        "shape-context",
        ShapeFeatures::Numbers(LeverFeatures::ShapeContext),
        "Counts of outline points in rings and wedges",
    ),
    ("corners", ShapeFeatures::Numbers(LeverFeatures::Corners), "Corners and centre of mass"),
    ("support", ShapeFeatures::Numbers(LeverFeatures::Support), "Support edge and centre of mass"),
    (
        "shape",
        ShapeFeatures::Numbers(LeverFeatures::Shape),
        "Corners, support edge and centre of mass",
    ),
    ("image", ShapeFeatures::Image(ImageFeatures::Image), "Mask from above, with convolutions"),
    (
        "image-code",
        ShapeFeatures::Image(ImageFeatures::ImageCode),
        "Mask from above, by an autoencoder",
    ),
    (
        "context-image",
        ShapeFeatures::Image(ImageFeatures::ContextImage),
        "Shape context, with convolutions",
    ),
    ("depth", ShapeFeatures::Image(ImageFeatures::Depth), "Heights from above, with convolutions"),
];
