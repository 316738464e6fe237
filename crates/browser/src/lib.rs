//! The planner in a page: the library in WebAssembly, behind texts and JSON.
//!
//! What a task file says, what is wrong with it, what changes in it, what is planned and how that is
//! shown: the library says all of it. Here it is only handed over. What is drawn and dragged is in
//! `page`.

mod edit;
mod follow;
mod solve;
mod table;

use std::sync::OnceLock;

use pushplan::ToolLibrary;
use wasm_bindgen::prelude::wasm_bindgen;

pub use solve::{Solved, solve};
pub use table::{bare, edit, example, examples, look, tools};

/// Once, before anything else: what goes wrong is told, and not only that something does.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|panic| follow::failed(&panic.to_string())));
}

/// The shipped tools.
fn library() -> Result<&'static ToolLibrary, String> {
    static LIBRARY: OnceLock<Result<ToolLibrary, String>> = OnceLock::new();
    let library = LIBRARY.get_or_init(|| {
        pushplan_arm::install();
        ToolLibrary::embedded().map_err(|error| error.to_string())
    });
    library.as_ref().map_err(Clone::clone)
}
