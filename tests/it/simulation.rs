//! The two engines against closed forms, symmetries and themselves.

mod determinism;
mod fixtures;
mod sliding;
mod travel;
