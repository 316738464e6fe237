//! Changes of single values in a hand-written file, which keep comments and layout.
//!
//! A value is changed at its place, which the reader knows (`place`, `change`, `flow`). The result
//! is read again and compared with the wanted values (`tree`). If they differ (anchors, words over
//! several lines), the whole text is written anew, which loses comments but never a value.
//! (`yamlpatch` does the same on tree-sitter, which is C; the page and users of the library compile
//! no C.)

mod apply;
mod change;
mod flow;
mod place;
mod tree;

pub use apply::{Edit, edit, values};
