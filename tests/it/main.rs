//! Tests across rooms, in one binary so that candle and rapier link once.

mod dataset;
mod planning;
mod simulation;
