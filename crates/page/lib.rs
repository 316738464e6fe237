//! What [pushplan](https://crates.io/crates/pushplan) writes next to its results so that others can play them:
//! style and scripts of its pages, for plans, runs and recordings in a browser, and scripts that play exported
//! scenes in MuJoCo.

/// The page's looks.
pub const STYLE: &str = include_str!("page.css");

/// What stands on the page before the script fills it.
pub const BODY: &str = include_str!("page.html");

/// What the page does. One script, so that one hash allows it and nothing else.
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

/// The 3-D view, which three.js draws.
pub const SOLID: &str = include_str!("script/solid.js");

/// Plays exported plans in MuJoCo, in Python.
pub const REPLAY: &str = concat!(include_str!("mujoco/replay.py"), include_str!("mujoco/judge.py"));

/// Plays exported motions in MuJoCo frame by frame, in Python, with the help of [`REPLAY`].
pub const FRAMES: &str = include_str!("mujoco/frames.py");

/// Plays exported lever-ups in MuJoCo, in Python.
pub const LEVER: &str = concat!(include_str!("mujoco/lever.py"), include_str!("mujoco/judge.py"));
