//! Plan pages in a notebook.

/// Height of the page in a notebook, pixels: its stage, controls and chart without scrolling.
const HEIGHT: u32 = 900;

/// A page as an element that holds all of it and may run its own script, but reach nothing of the
/// notebook.
pub fn frame(page: &str) -> String {
    let page = page.replace('&', "&amp;").replace('"', "&quot;");
    format!(
        "<iframe srcdoc=\"{page}\" sandbox=\"allow-scripts\" width=\"100%\" height=\"{HEIGHT}\" \
         style=\"border: 0\"></iframe>"
    )
}
