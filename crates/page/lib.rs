//! Files that [pushplan](https://crates.io/crates/pushplan) writes next to its results so that
//! others can play them.
//!
//! They are the style and scripts of its pages, for plans, runs and recordings in a browser, and
//! scripts that play exported scenes in MuJoCo.

/// Style sheet of the page.
pub const STYLE: &str = include_str!("page.css");

/// Body of the page, before the script fills it.
pub const BODY: &str = include_str!("page.html");

/// Script of the page, a single one, so that one hash allows it and nothing else.
pub const SCRIPT: &str = concat!(
    include_str!("script/elements.js"),
    include_str!("script/shapes.js"),
    include_str!("script/data.js"),
    include_str!("script/replay.js"),
    include_str!("script/clock.js"),
    include_str!("script/stage.js"),
    include_str!("script/chart.js"),
    include_str!("script/ends.js"),
    include_str!("script/tables.js"),
    include_str!("script/candidates.js"),
    include_str!("script/run.js"),
    include_str!("script/belief.js"),
    include_str!("script/copy.js"),
    include_str!("script/controls.js"),
);

/// Script of the 3-D view, drawn with three.js.
pub const SOLID: &str = concat!(include_str!("script/names.js"), include_str!("script/solid.js"));

/// Python script that plays exported plans in MuJoCo.
pub const REPLAY: &str = concat!(
    include_str!("mujoco/replay.py"),
    include_str!("mujoco/travel.py"),
    include_str!("mujoco/judge.py")
);

/// Python script that plays exported motions in MuJoCo frame by frame; it uses [`REPLAY`].
pub const FRAMES: &str = include_str!("mujoco/frames.py");

/// Python script that plays exported lever-ups in MuJoCo.
pub const LEVER: &str = concat!(include_str!("mujoco/lever.py"), include_str!("mujoco/judge.py"));
