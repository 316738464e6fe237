//! The error type of the public interface.

use std::fmt;

use thiserror::Error;

use crate::asset::Faults;
use crate::effect::ModelError;
use crate::geometry::PolygonError;
use crate::scene::{SpecError, ToolError};
use crate::solve::SolveError;

/// Any error of the public interface, for `fn main() -> Result<(), pushplan::Error>`.
///
/// Rust prints an error that leaves `main` with [`Debug`](fmt::Debug). Here that is the text of
/// [`Display`](fmt::Display): file, line and advice where a file is at fault.
#[derive(Error)]
#[non_exhaustive]
pub enum Error {
    /// Faults in files, or two tools of one name.
    #[error(transparent)]
    Files(#[from] Faults),
    /// Parts that do not form a tool.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// Corners that do not form a convex polygon.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
    /// An effect model that cannot be built because of its weights.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A text that does not name an effect model.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// A task that cannot be attempted.
    #[error(transparent)]
    Task(#[from] SolveError),
    /// An error of a crate that builds on this one.
    #[error(transparent)]
    Other(#[from] Box<dyn std::error::Error + Send + Sync>),
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
