//! Part of [three.js](https://threejs.org) that draws the 3-D view of
//! [pushplan](https://crates.io/crates/pushplan)'s pages, embedded so that a page needs no network.

/// Minified script, compressed with gzip and encoded in base 64, which a browser unpacks; its
/// global name is `THREE`.
pub const THREE: &str = include_str!("three.min.js.gz.base64");
