//! Tests across rooms, in one binary so that candle and rapier link once.

mod architecture;
mod assets;
mod baselines;
mod bench_store;
mod benchmarks;
mod cli;
mod crowd_errors;
mod crowds;
mod dataset;
mod evaluation;
mod extremes;
mod jointed;
mod network;
mod outside;
mod pairs;
mod planning;
mod pruning;
mod random_tasks;
mod readme;
mod simulation;
mod solving;
mod symmetry;
mod tool_choice;
mod tradeoff;
mod training;
mod verification;
