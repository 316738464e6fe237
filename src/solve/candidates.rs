//! Candidates of a search, to be refined and verified.

use crate::plan::SearchResult;

/// Candidates of one length, best first.
#[derive(Clone)]
pub(super) struct Candidates {
    pub found: Vec<SearchResult>,
    pub pushes: usize,
    /// Whether hardening may make these candidates more robust.
    pub hardenable: bool,
}
