//! Tests of data and training, in one binary.

mod arrays;
mod beliefs;
mod command;
mod crowds;
mod dataset;
mod descent;
mod lever;
mod lever_data;
mod lever_twins;
mod predictor;
mod pruning;
mod ranges;
mod regulator;
mod shards;
mod until;

// Modules shared with the tests of the product.
#[path = "../../../../tests/it/believing.rs"]
mod believing;
#[cfg(unix)]
#[path = "../../../../tests/it/interrupted.rs"]
mod interrupted;
#[path = "../../../../tests/it/mujoco_python.rs"]
mod mujoco_python;
#[path = "../../../../tests/it/pages.rs"]
mod pages;
#[path = "../../../../tests/it/program.rs"]
mod program;
#[path = "../../../../tests/it/random_network.rs"]
#[allow(dead_code)]
mod random_network;
#[path = "../../../../tests/it/random_regulator.rs"]
mod random_regulator;
#[path = "../../../../tests/it/sharding.rs"]
mod sharding;

/// Paths of the repository and the program.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const PROGRAM: &str = env!("CARGO_BIN_EXE_pushplan-learn");
