//! Long jobs on disk, such as benchmarks and training data: one record per task, saved immediately.
//!
//! Runs can be resumed, split into shards and merged again to the same bytes. A run is a folder:
//!
//! ```text
//! manifest.json   kind of job: suite, number of tasks, seed, settings, model and the digest of its
//!                 weights, format version, and the shard, if it is one
//! records.jsonl   {"index": 0, "record": {...}}, a line per finished task, in order
//! records.bin     the records in binary form for large data: length, record, checksum
//! times.jsonl     {"index": 0, "seconds": {"total": 0.12, ...}}, a line for wall times
//! ```
//!
//! The bytes of `manifest.json` and of the records are reproducible. They do not depend on
//! interruptions, on shards, or on the number of threads. Wall times in `times.jsonl` differ
//! between runs.
//!
//! Only one process at a time writes to a folder, in which `.pushplan-lock` names the writer.
//! Shards have separate folders, so that no two machines write to the same one.
//!
//! This module is independent of the content of records, and does not draw.

mod digest;
mod error;
mod form;
mod journal;
mod lock;
mod manifest;
mod merge;
mod numbers;
mod run;
mod shard;
mod status;
mod times;

pub use digest::digest;
pub use error::StoreError;
pub use form::Form;
pub use journal::{Held, Journal, Look, read_records};
pub use lock::FolderLock;
pub use manifest::RunManifest;
pub use merge::{line_index, merge_runs};
pub use run::{Finished, Measured, Store};
pub use shard::{Shard, ShardError};
pub use status::{RunStatus, ShardStatus};
pub use times::Seconds;
