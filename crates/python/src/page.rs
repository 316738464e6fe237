//! Plan pages in a notebook.

/// Height of the page in a notebook, pixels: its stage, controls and chart fit without scrolling.
const HEIGHT: u32 = 900;

/// Returns a page as an `iframe` that holds all of it. The page may run its own script but cannot
/// access the notebook.
pub fn frame(page: &str) -> String {
    let page = page.replace('&', "&amp;").replace('"', "&quot;");
    format!(
        "<iframe srcdoc=\"{page}\" sandbox=\"allow-scripts\" width=\"100%\" height=\"{HEIGHT}\" \
         style=\"border: 0\"></iframe>"
    )
}
