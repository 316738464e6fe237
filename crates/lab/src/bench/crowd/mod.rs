//! Errors of effect models on tables full of objects: the test sets of Tekden (2020).
//!
//! The tool's motion is given. Everything else is rolled out from the first frame alone and
//! compared with the ground truth at each of its frames. Nothing is rendered and no file is read
//! here.

mod family;
mod report;

pub use family::{CrowdFamily, CrowdSet};
pub use report::CrowdReport;
