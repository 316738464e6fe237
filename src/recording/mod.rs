//! Recordings: the observed motion on a table, frame by frame, and its use.
//!
//! The types of a recording, motions that are impossible on a real table (`rules`), and the
//! pusher's poses as a motion for effect models (`replay`). The module `asset` reads files and
//! reports the places at which a rule is broken.

mod observed;
mod replay;
mod rules;

pub use observed::{RecordedFrame, Recording};
pub use replay::{Instant, Replay};
pub use rules::{Body, Gap, Jump, Moving, Strange, gaps, jumps};
