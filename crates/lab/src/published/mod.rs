//! Published tables: a registry of all of them, the commands behind them, and their age.
//!
//! A table stands on a page of `crates/lab/results` between two comments, below its command. It is
//! stale if weights or answers of the program differ from those that it was measured with.

mod fingerprint;
mod markdown;
mod page;
mod place;
mod registry;
mod run;
mod table;

pub use fingerprint::Fingerprint;
pub use markdown::select;
pub use page::{marked, place, recorded};
pub use place::{Age, Place};
pub use run::{RunError, run};
pub use table::{Input, Pick, Published, tables};
