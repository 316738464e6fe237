//! Errors of effect models on tables full of objects: the thesis' test sets.
//!
//! The tool's motion is given; everything else is rolled out from the first frame alone and
//! compared with the truth at every frame of it. Nothing is drawn and no file is read here.

mod family;
mod report;

pub use family::{CrowdFamily, CrowdSet};
pub use report::CrowdReport;
