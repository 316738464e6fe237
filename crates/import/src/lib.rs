//! Import of other formats: tools and scenes from MJCF (MuJoCo), URDF and meshes.
//!
//! A file is read into plain bodies with solids, poses in the world and masses ([`Model`], by
//! `mjcf`, `urdf` or `mesh`). These are converted to a [`Tool`](pushplan::scene::Tool) or a
//! [`Scene`](pushplan::scene::Scene) (`convert`). Content that pushplan cannot express is a fault
//! with its place and advice; content that it expresses slightly differently is a note. Nothing is
//! dropped silently, simulated or written.
//!
//! XML is parsed with `roxmltree` directly, because faults that point to a line were worth the few
//! hundred lines. The existing crates for these formats have gaps. `mjcf-rs` 0.36 keeps no places,
//! ignores unknown elements and attributes, and panics on an `eulerseq` of four letters. `urdf-rs`
//! 0.10 keeps no places either, reads `0.1 x 0.2 0.3` as three numbers and a missing mass as zero.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod attributes;
mod convert;
mod crowd;
mod diagnostic;
pub mod foreign;
mod mesh;
mod mjcf;
mod model;
mod read;
mod rubbing;
mod spliced;
mod turns;
mod urdf;
mod xml;

pub use attributes::{Treatment, treatment};
pub use convert::{Imported, ImportedScene, Wanted, objects, tool};
pub use diagnostic::{Effect, Note};
pub use mesh::{Counted, Mesh};
pub use model::{Beyond, Body, Material, Model, Motion, Outline, Place, Solid, Weight};
pub use read::{Language, Reading, parse, read};
