//! Tests across rooms, in one binary so that rapier links once. Those of training, which are built only
//! with candle, stand in `tests/training`.

mod architecture;
mod assets;
mod baselines;
mod belief;
mod bench_store;
mod benchmarks;
mod cli;
mod closed_loop;
mod crowd_errors;
mod crowds;
mod dataset;
mod evaluation;
mod export;
mod extremes;
mod facade;
mod fitting;
mod fixtures;
#[cfg(unix)]
mod interrupted;
mod jointed;
mod joints_bench;
mod models;
mod network;
mod outside;
mod pairs;
mod pictures;
mod plan_page;
mod planning;
mod prior;
mod prisms;
mod pruning;
mod random_network;
mod random_regulator;
mod random_tasks;
mod readme;
mod real_pushes;
mod regulator;
mod seams;
mod shipped_network;
mod simulation;
mod solving;
mod symmetry;
mod tool_choice;
mod tradeoff;
mod verification;
