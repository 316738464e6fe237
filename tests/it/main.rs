//! Tests across modules, in one binary so that rapier links once. The crates in `crates` have their
//! own tests, which share helpers with these.

mod architecture;
mod arms;
mod assets;
mod baselines;
mod belief;
mod believing;
mod bench_store;
mod benchmarks;
mod book;
mod clearing;
mod cli;
mod closed_loop;
mod constraints;
mod corrections;
mod coverages;
mod design;
mod doors;
mod edited_plans;
mod english;
mod export;
mod facade;
mod fitting;
mod fixtures;
mod formats;
mod gaps;
mod group_goals;
mod in_motion;
#[cfg(unix)]
#[allow(dead_code)]
mod interrupted;
mod jointed;
mod judged;
mod lever_engine;
mod lever_follow_up;
mod lever_scene;
mod levers;
mod lift_off;
mod models;
mod mujoco_python;
mod network;
mod off_table;
mod out_of_range;
mod overhead;
mod owner;
mod pages;
mod pairs;
mod pictures;
mod plan_page;
mod planning;
mod predicted_joints;
mod prisms;
mod program;
mod push_rules;
mod raised;
mod random_network;
mod random_regulator;
mod readme;
mod real_pushes;
mod recorded;
mod recorded_pushes;
mod regulator;
mod run_joints;
mod run_learning;
mod run_rules;
mod seams;
mod second_opinion;
mod several_goals;
#[allow(dead_code)]
mod sharding;
mod shards;
mod simulation;
mod solving;
mod squeezes;
mod table_fit;
mod things;
mod tool_change;
mod tool_choice;
mod tool_graph;
mod transport;
mod verification;
mod whole_motion;
mod why_not;

/// Repository root, and the program under test.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const PROGRAM: &str = env!("CARGO_BIN_EXE_pushplan");
