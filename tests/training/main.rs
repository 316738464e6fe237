//! Training, which is built only with candle: `cargo test --release --features train`.

mod command;
mod descent;
mod lever;
mod lever_parts;
mod predictor;
mod regulator;

// What these tests share with all others.
#[cfg(unix)]
#[path = "../it/interrupted.rs"]
mod interrupted;
#[path = "../it/pages.rs"]
mod pages;
#[path = "../it/random_network.rs"]
#[allow(dead_code)]
mod random_network;
#[path = "../it/random_regulator.rs"]
mod random_regulator;
