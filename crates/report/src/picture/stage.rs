//! Animation under construction: drawing, keyframes, and timeline.

use crate::keyframes::{Key, Keyframes, short};
use crate::svg::Svg;
use pushplan::geometry::{Pose, Vector};

use super::{timeline::Timeline, view::View};

/// Smallest visible change, pixels and degrees.
pub const SEEN: f64 = 0.2;
/// Duration of fading at both ends of the loop, seconds.
const FADE: f64 = 0.35;
/// Duration of fading of temporary elements, seconds.
const EDGE: f64 = 0.15;

/// Animation under construction.
pub struct Stage {
    pub svg: Svg,
    pub loops: Keyframes,
    pub view: View,
    pub timeline: Timeline,
}

impl Stage {
    /// Returns an empty picture of `size` pixels.
    pub fn new(size: Vector, title: &str, view: View, timeline: Timeline) -> Self {
        let mut loops = Keyframes::new(timeline.total);
        let end = timeline.total;
        let keys = [(0.0, 0.0), (FADE, 1.0), (end - FADE, 1.0), (end, 0.0)];
        loops.animate("layer", &keys.map(|(at, v)| Key { at, value: [v] }), [0.01], opacity);
        Self { svg: Svg::new(size.x, size.y, title), loops, view, timeline }
    }

    /// Opens a group that fades out and in at the jump to the start of the loop.
    pub fn open_layer(&mut self) {
        self.svg.open_shown("layer", 1.0);
    }

    /// Opens a group that is visible from `since` to `until`, seconds. `still` makes it visible
    /// without animation.
    pub fn open_between(&mut self, class: &str, since: f64, until: f64, still: bool) {
        let end = self.timeline.total;
        let keys = [
            (0.0, 0.0),
            (since, 0.0),
            (since + EDGE, 1.0),
            (until - EDGE, 1.0),
            (until, 0.0),
            (end, 0.0),
        ];
        self.loops.animate(class, &keys.map(|(at, v)| Key { at, value: [v] }), [0.01], opacity);
        self.svg.open_shown(class, if still { 1.0 } else { 0.0 });
    }

    /// Closes the last `count` groups.
    pub fn close(&mut self, count: usize) {
        (0..count).for_each(|_| self.svg.close());
    }

    /// Returns the finished document.
    pub fn finish(mut self) -> String {
        self.svg.style(&self.loops.finish());
        self.svg.finish()
    }
}

/// Formats a translation in pixels.
pub fn shift([x, y]: [f64; 2]) -> String {
    format!("transform:translate({}px,{}px)", short(x, 1), short(y, 1))
}

/// Formats a rotation in degrees.
pub fn turn([degrees]: [f64; 1]) -> String {
    format!("transform:rotate({}deg)", short(degrees, 1))
}

/// Returns the heading in degrees clockwise on the page, whose y axis points down.
pub fn clockwise(pose: &Pose) -> f64 {
    -pose.heading.to_degrees()
}

fn opacity([shown]: [f64; 1]) -> String {
    format!("opacity:{}", short(shown, 2))
}
