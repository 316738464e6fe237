//! Recordings: what was seen on a table, frame by frame, and what follows from that.
//!
//! The types of a recording, what no real table does between two of its frames (`rules`), and the
//! pusher's poses as a motion that an effect model can play (`replay`). Reads no files: that is
//! `asset`, which says where in a file a rule is broken.

mod observed;
mod replay;
mod rules;

pub use observed::{RecordedFrame, Recording};
pub use replay::{Instant, Replay};
pub use rules::{Body, Gap, Jump, Moving, Strange, gaps, jumps};
