//! JSON schemas (draft 2020-12) of the documents that `--json` prints, with units.
//!
//! Parts that also stand in plan files take their schemas from there. All objects are closed: a key
//! that a document contains and its schema does not is a defect, which tests find. This module
//! does not read or check documents.

mod belief;
mod bench;
mod checked;
mod design;
mod errors;
mod fit;
mod kind;
mod prediction;
mod run;
mod shape;
mod solution;
mod verdict;

pub use kind::DocumentKind;
