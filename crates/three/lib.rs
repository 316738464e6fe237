//! The part of [three.js](https://threejs.org) that draws the 3-D view of
//! [pushplan](https://crates.io/crates/pushplan)'s pages, for a page that needs no network.

/// Minified, gzipped and in base 64; a browser unpacks it. Its global name is `THREE`.
pub const THREE: &str = include_str!("three.min.js.gz.base64");
