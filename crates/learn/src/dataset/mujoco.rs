//! Ground truth from MuJoCo, an engine that shares no code with ours.
//!
//! Scenes are exported to a Python process per thread, which plays them one after another. Equal
//! versions on equal processor types yield identical bits; otherwise only statistics are
//! comparable.

use std::cell::RefCell;
use std::env;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::OnceLock;

use pushplan::internals::geometry::{Pose, Vector};
use pushplan::internals::{
    outcome::Frame,
    scene::{Scene, State, Velocity},
    task::ToolMotion,
};
use pushplan_export::{FRAMES_SCRIPT, REPLAY_SCRIPT, motion_mjcf};
use serde::Deserialize;
use serde_json::json;
use tempfile::TempDir;

use super::error::DatasetError;

/// Environment variable with the path of a Python that has MuJoCo; default `python3`.
const NAMED: &str = "PUSHPLAN_PYTHON";

/// Python process that plays scenes in MuJoCo.
struct Player {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
    version: String,
    /// Temporary folder with the scripts.
    _folder: TempDir,
}

/// Answer of a player.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Answer {
    Frames(Vec<Instant>),
    Failed(#[allow(dead_code)] String),
}

/// State at the end of a frame.
#[derive(Deserialize)]
struct Instant {
    time: f64,
    stroke: usize,
    /// Values x, y, heading and their velocities for every object.
    objects: Vec<[f64; 6]>,
}

thread_local! {
    static PLAYER: RefCell<Option<Player>> = const { RefCell::new(None) };
}

/// Returns the version of the installed MuJoCo.
///
/// # Errors
/// Returns [`DatasetError::Player`] if MuJoCo is not installed.
pub(super) fn version() -> Result<&'static str, DatasetError> {
    static VERSION: OnceLock<String> = OnceLock::new();
    if let Some(version) = VERSION.get() {
        return Ok(version);
    }
    let version = Player::start()?.version.clone();
    Ok(VERSION.get_or_init(|| version))
}

/// Returns the frames of a motion, starting with the initial one.
///
/// Returns `None` if an object topples, jams, is under the tool when it is set down, or never comes
/// to rest.
///
/// # Errors
/// Returns [`DatasetError::Player`] if MuJoCo is not installed or its process ends.
pub(super) fn play(scene: &Scene, motion: &ToolMotion) -> Result<Option<Vec<Frame>>, DatasetError> {
    let mjcf = motion_mjcf("episode", scene, motion)
        .map_err(|error| DatasetError::Player(error.to_string()))?;
    let counts: Vec<usize> = motion.strokes.iter().map(|stroke| stroke.frames()).collect();
    let request = json!({"scene": mjcf, "frames": counts}).to_string();
    let answer = PLAYER.with_borrow_mut(|player| {
        let running = match player {
            Some(running) => running,
            None => player.insert(Player::start()?),
        };
        running.ask(&request)
    })?;
    let Answer::Frames(instants) = answer else { return Ok(None) };
    let start = scene.start();
    let frames = instants.into_iter().enumerate().map(|(index, instant)| Frame {
        time: instant.time,
        stroke: instant.stroke,
        tool: Pose::default(),
        // The initial state is as stated, before bodies sink into contacts.
        state: if index == 0 { start.clone() } else { state(&instant.objects) },
        blade: None,
    });
    Ok(Some(with_tools(frames.collect(), motion))
        .filter(|frames| frames.len() > 1 && frames.iter().all(|frame| frame.state.is_finite())))
}

fn state(objects: &[[f64; 6]]) -> State {
    let mut state = State::default();
    for [x, y, heading, along_x, along_y, angular] in objects {
        state.poses.push(Pose { position: Vector::new(*x, *y), heading: *heading });
        state
            .velocities
            .push(Velocity { linear: Vector::new(*along_x, *along_y), angular: *angular });
    }
    state
}

/// Inserts the poses of the tool into the frames.
fn with_tools(mut frames: Vec<Frame>, motion: &ToolMotion) -> Vec<Frame> {
    let (mut stroke, mut done) = (0, 0);
    for (index, frame) in frames.iter_mut().enumerate() {
        if frame.stroke != stroke {
            (stroke, done) = (frame.stroke, 0);
        }
        if index > 0 {
            done += 1;
        }
        let moved = &motion.strokes[stroke];
        let share = done.min(moved.frames()) as f64 / moved.frames() as f64;
        frame.tool = moved.from.towards(&moved.to, share);
    }
    frames
}

impl Player {
    fn start() -> Result<Self, DatasetError> {
        let python = env::var(NAMED).unwrap_or_else(|_| "python3".to_owned());
        let failed = |what: &str, error: &dyn std::fmt::Display| {
            let why = format!("{what} with `{python}`: {error}");
            DatasetError::Player(why)
        };
        let folder =
            tempfile::tempdir().map_err(|error| failed("cannot prepare MuJoCo", &error))?;
        let write = |path: &Path, text: &str| fs::write(path, text);
        let script = folder.path().join("frames.py");
        write(&script, FRAMES_SCRIPT)
            .and_then(|()| write(&folder.path().join("replay.py"), REPLAY_SCRIPT))
            .map_err(|error| failed("cannot prepare MuJoCo", &error))?;
        let mut child = Command::new(&python)
            .arg(&script)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| failed("cannot run MuJoCo", &error))?;
        let (Some(requests), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(failed("cannot run MuJoCo", &"no pipes"));
        };
        let mut answers = BufReader::new(answers);
        let mut line = String::new();
        let read = answers.read_line(&mut line);
        let version: Option<String> = read.ok().and_then(|_| serde_json::from_str(&line).ok());
        match version {
            Some(version) => Ok(Self { child, requests, answers, version, _folder: folder }),
            None => Err(failed("cannot run MuJoCo", &"it reports no version")),
        }
    }

    fn ask(&mut self, request: &str) -> Result<Answer, DatasetError> {
        let ended =
            |why: &dyn std::fmt::Display| DatasetError::Player(format!("MuJoCo ended: {why}"));
        writeln!(self.requests, "{request}").map_err(|error| ended(&error))?;
        let mut line = String::new();
        self.answers.read_line(&mut line).map_err(|error| ended(&error))?;
        serde_json::from_str(&line).map_err(|error| ended(&error))
    }
}

impl Drop for Player {
    /// Ends the process, ignoring errors.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
