//! One error for all that the public interface returns.

use std::fmt;

use thiserror::Error;

use crate::asset::Faults;
use crate::effect::ModelError;
use crate::geometry::PolygonError;
use crate::scene::{SpecError, ToolError};
use crate::solve::SolveError;

/// Any error of the public interface, for `fn main() -> Result<(), pushplan::Error>`.
///
/// Rust prints an error that leaves `main` by [`Debug`](fmt::Debug); here that is the text of
/// [`Display`](fmt::Display): with file, line and advice where a file is at fault.
#[derive(Error)]
#[non_exhaustive]
pub enum Error {
    /// Files with faults, or two tools of one name.
    #[error(transparent)]
    Files(#[from] Faults),
    /// Parts that do not make a tool.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// Corners that do not make a convex polygon.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
    /// An effect model that cannot be made, for its weights.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A text that does not name an effect model.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// A task that cannot even be tried.
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
