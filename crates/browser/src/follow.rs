//! What a worker hears while it plans. It is stopped from outside, by ending it: a worker that plans hears
//! nothing.

use pushplan::watch::Watch;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// What is being done, and how much of how much of it is.
    #[wasm_bindgen(js_name = pushplanTold)]
    fn told(stage: &str, done: f64, total: f64);

    /// The best plan so far.
    #[wasm_bindgen(js_name = pushplanSoFar)]
    fn so_far(answer: &str);

    /// A defect of the planner.
    #[wasm_bindgen(js_name = pushplanFailed)]
    pub fn failed(message: &str);
}

/// Tells the page.
pub struct Following;

impl Watch for Following {
    fn stage(&self, what: &str) {
        told(what, 0.0, 0.0);
    }

    fn progress(&self, done: u64, total: u64) {
        told("", done as f64, total as f64);
    }

    fn so_far(&self, answer: &str) {
        so_far(answer);
    }
}
