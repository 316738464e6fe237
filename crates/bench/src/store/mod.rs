//! Long jobs on disk: a record a task, kept as soon as it is there; resumed, split into shards and
//! merged again to the same bytes. Benchmarks and training data are both such runs.
//!
//! A run is a folder:
//!
//! ```text
//! manifest.json   what is measured or made: suite, number of tasks, seed, settings, model and the
//!                 digest of its weights, format version, and the shard, if it is one
//! records.jsonl   {"index": 0, "record": {...}}, a line a finished task, in order
//! records.bin     the same for much data: length, record, checksum
//! times.jsonl     {"index": 0, "seconds": {"total": 0.12, ...}}, a line for wall times
//! ```
//! `manifest.json` and the records are the same bytes however often a run was interrupted, whether
//! it was made whole or merged from shards, and for any number of threads. Times differ from run
//! to run; `times.jsonl` is not part of that promise. One process at a time writes to a folder: while
//! one does, `.pushplan-lock` is there and says which. Shards have folders of their own, so that no two
//! machines ever write to one.
//!
//! Knows nothing of what a record holds, and draws nothing.

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
