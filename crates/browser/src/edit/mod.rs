//! Changes of single values in a file that somebody wrote: their comments and layout stay.
//!
//! A value is changed at its place, which the reader knows (`place`, `change`, `flow`). What comes of that is
//! read again and compared with what was wanted (`tree`); where it is something else (anchors, words over
//! several lines), the whole text is written again, which loses comments but never a value. (`yamlpatch` does
//! as much on tree-sitter, which is C; the page, and those who link the library, compile none.)

mod apply;
mod change;
mod flow;
mod place;
mod tree;

pub use apply::{Edit, edit, values};
