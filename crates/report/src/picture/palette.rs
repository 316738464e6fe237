//! Colours of the scene picture, distinguishable by colour-blind readers. Dashes and fills repeat
//! the meaning of each colour.

use crate::svg::{Font, Style};

pub const INK: &str = "#212529";
pub const FAINT_INK: &str = "#6c757d";
pub const GOAL: &str = "#9c36b5";
pub const TOOL: &str = "#7f5539";
pub const PREDICTED: &str = "#e8590c";
pub const PLANAR: &str = "#2b8a3e";
pub const SPATIAL: &str = "#1864ab";
pub const GOOD: &str = "#2b8a3e";
pub const BAD: &str = "#c92a2a";

/// Font of the lines below the title.
pub const NOTE: Font = Font::new(12.5, FAINT_INK);

pub const PLOT: Style = Style::fill("#fbfcfd").outlined("#dee2e6", 1.0);
pub const GRID: Style = Style::stroke("#e9ecef", 1.0);
pub const GRID_STRONG: Style = Style::stroke("#d3d9df", 1.0);
pub const REACH_AREA: Style = Style::fill("#4dabf7").opacity(0.06);
pub const REACH_RIM: Style = Style::stroke("#4dabf7", 1.2).dashed("2 4");
pub const OBSTACLE: Style = Style::fill("url(#hatch)").outlined("#495057", 1.4);
/// Obstacles above the table are outlined only, so that they do not hide bodies below them.
pub const OVERHEAD: Style = Style::stroke("#495057", 1.6).dashed("9 4");
pub const KEEP_OUT: Style =
    Style::fill("#fa5252").outlined("#c92a2a", 1.2).dashed("3 3").opacity(0.25);
pub const GOAL_OBJECT: Style = Style::fill("#74b3f0").outlined("#1c6fbf", 1.6);
pub const OTHER_OBJECT: Style = Style::fill("#dee2e6").outlined("#868e96", 1.4);
pub const GOAL_WAY: Style = Style::stroke("#1c6fbf", 2.4);
pub const OTHER_WAY: Style = Style::stroke("#868e96", 1.4);
pub const GOAL_AREA: Style = Style::fill(GOAL).opacity(0.10);
/// Opacity of the distances at which a goal is met.
pub const GOAL_BAND: f64 = 0.25;
pub const GOAL_RIM: Style = Style::stroke(GOAL, 1.6);
pub const GOAL_MISS: Style = Style::stroke(GOAL, 1.2).dashed("1 4");
pub const TOOL_FILL: &str = "#d0ab83";
pub const PROGRESS: Style = Style::fill(SPATIAL);
pub const PROGRESS_BED: Style = Style::fill("#e9ecef");
/// Opacity of an object's start pose in an animation.
pub const START: f64 = 0.3;
/// Opacity of the tool before and after a push.
pub const TOOL_BEFORE: f64 = 0.28;
pub const TOOL_AFTER: f64 = 0.72;
/// Opacity of a moving tool, and of a tool lifted over bodies.
pub const TOOL_AT_WORK: f64 = 0.9;
pub const TOOL_LIFTED: f64 = 0.4;
pub const TOOL_HOLD: Style = Style::stroke(TOOL, 2.4);

/// Hatching for immovable bodies.
pub const HATCH: &str = "<pattern id=\"hatch\" width=\"7\" height=\"7\" \
    patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">\
    <rect width=\"7\" height=\"7\" fill=\"#e9ecef\"/>\
    <line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"7\" stroke=\"#868e96\" stroke-width=\"2.4\"/></pattern>";
