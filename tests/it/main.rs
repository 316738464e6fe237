//! Tests across rooms, in one binary so that candle and rapier link once.

mod architecture;
mod assets;
mod dataset;
mod planning;
mod simulation;
