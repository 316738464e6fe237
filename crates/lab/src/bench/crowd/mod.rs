//! Errors of effect models on tables full of objects: the thesis' test sets, and the user's own
//! recordings.
//!
//! The tool's motion is given; everything else is rolled out from the first frame alone and
//! compared with the truth at every frame of it. Nothing is drawn and no file is read here.

mod family;
mod measure;
mod report;

pub use family::{CrowdFamily, CrowdSet};
pub use measure::evaluate_crowd;
pub use report::{CrowdModel, CrowdReport, CurvePoint, OneError, Phases};
