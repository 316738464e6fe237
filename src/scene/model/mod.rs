//! Identifiers of effect models: typed values with one text form, used on the command line, by
//! efforts, in benchmarks and in files. The models themselves are in `effect`.

mod assumption;
mod engine;
mod frame_travel;
mod spec;
mod text;

pub use assumption::{Assumptions, JointBelief};
pub use engine::Engine;
pub use frame_travel::FRAME_TRAVEL;
pub use spec::{CORRECTED, ModelKind, ModelPart, ModelSpec, Rate, Stride};
pub use text::SpecError;
