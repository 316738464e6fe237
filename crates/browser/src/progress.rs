//! Progress reports of a worker that plans. The page cancels a worker by terminating it, because a
//! planning worker receives no messages.

use pushplan::progress::Progress;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Reports the present stage and the finished share of its work.
    #[wasm_bindgen(js_name = pushplanProgress)]
    fn report(stage: &str, done: f64, total: f64);

    /// Reports the best plan so far.
    #[wasm_bindgen(js_name = pushplanSoFar)]
    fn so_far(answer: &str);

    /// Reports a defect of the planner.
    #[wasm_bindgen(js_name = pushplanFailed)]
    pub fn failed(message: &str);
}

/// Progress observer that reports to the page.
pub struct WorkerProgress;

impl Progress for WorkerProgress {
    fn stage(&self, what: &str) {
        report(what, 0.0, 0.0);
    }

    fn update(&self, done: u64, total: u64) {
        report("", done as f64, total as f64);
    }

    fn so_far(&self, answer: &str) {
        so_far(answer);
    }
}
