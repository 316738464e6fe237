//! Long benchmarks on disk: one record a task, kept after each; resumed, split into shards and
//! merged again to the same bytes.
//!
//! A run is a folder:
//!
//! ```text
//! manifest.json   what is measured: suite, number of tasks, seed, settings, model and the digest
//!                 of its weights, format version, and the shard, if it is one
//! records.jsonl   {"index": 0, "record": {...}}, a line a finished task, in order
//! times.jsonl     {"index": 0, "seconds": {"total": 0.12, ...}}, the same for wall times
//! ```
//! `manifest.json` and `records.jsonl` are the same bytes however often a run was interrupted,
//! whether it was made whole or merged from shards, and for any number of threads. Times differ
//! from run to run; `times.jsonl` is not part of that promise.
//!
//! Knows nothing of what a record holds, and draws nothing.

mod error;
mod files;
mod manifest;
mod merge;
mod run;
mod shard;

pub use error::StoreError;
pub use manifest::{RunManifest, digest};
pub use merge::merge_runs;
pub use run::{Finished, Measured, Seconds, Store};
pub use shard::{Shard, ShardError};
