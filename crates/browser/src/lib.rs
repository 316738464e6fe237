//! The planner in a web page: the library in WebAssembly, behind texts and JSON.
//!
//! The library reads, edits and solves tasks, and renders results and faults; this crate only
//! passes them on. Drawing and dragging is implemented in `page`.

mod edit;
mod progress;
mod solve;
mod table;

use std::sync::OnceLock;

use pushplan::ToolLibrary;
use wasm_bindgen::prelude::wasm_bindgen;

pub use solve::{Solved, solve};
pub use table::{bare, edit, example, examples, look, tools};

/// Installs a panic hook that reports the message of a panic; runs once, before anything else.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|panic| progress::failed(&panic.to_string())));
}

/// Returns the shipped tools.
fn library() -> Result<&'static ToolLibrary, String> {
    static LIBRARY: OnceLock<Result<ToolLibrary, String>> = OnceLock::new();
    let library = LIBRARY.get_or_init(|| {
        pushplan_arm::install();
        ToolLibrary::embedded().map_err(|error| error.to_string())
    });
    library.as_ref().map_err(Clone::clone)
}
