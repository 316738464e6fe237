//! Files of other programs in: tools and scenes from MJCF (MuJoCo), URDF and meshes.
//!
//! A file is read into plain bodies with solids, poses in the world and masses ([`Model`], by
//! `mjcf`, `urdf` or `mesh`), and those become a [`Tool`](pushplan::scene::Tool) or a
//! [`Scene`](pushplan::scene::Scene) (`convert`). What pushplan cannot express is a fault with its
//! place and what to do; what it expresses slightly differently is a note. Nothing is left out
//! silently, nothing is simulated, nothing is written.
//!
//! XML is read with `roxmltree` itself. Of the crates for these formats `mjcf-rs` 0.36 keeps no
//! places, passes over elements and attributes that it does not know, and an `eulerseq` of four
//! letters makes it panic; `urdf-rs` 0.10 keeps no places either, reads `0.1 x 0.2 0.3` as three
//! numbers and a missing mass as zero. Faults that point to a line were worth the few hundred lines.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod convert;
mod crowd;
mod fault;
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

pub use convert::{Imported, ImportedScene, Wanted, objects, tool};
pub use mesh::{Counted, Mesh};
pub use model::{Body, Material, Model, Motion, Outline, Place, Solid, Weight};
pub use read::{Language, Reading, parse, read};
