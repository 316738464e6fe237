//! What a plan page holds, as its script reads it.
//!
//! Lengths are whole hundredths of a millimetre, angles and times whole ten-thousandths of a radian
//! and a second: short, and finer than anything that is shown.

use serde::Serialize;
use serde_json::Value as Json;

use pushplan::geometry::{Pose, Vector};

/// A length in metres, in hundredths of a millimetre.
pub fn length(metres: f64) -> i64 {
    (metres * 1e5).round() as i64
}

/// An angle in radians or a time in seconds, in ten-thousandths.
pub fn fine(value: f64) -> i64 {
    (value * 1e4).round() as i64
}

/// A position or an extent.
pub fn point(vector: Vector) -> [i64; 2] {
    [length(vector.x), length(vector.y)]
}

/// Position and heading.
pub fn pose(pose: &Pose) -> [i64; 3] {
    [length(pose.position.x), length(pose.position.y), fine(pose.heading)]
}

/// A whole page.
#[derive(Serialize)]
pub struct Data {
    /// Name of the task.
    pub task: String,
    /// The task's description.
    pub description: String,
    /// How it ended, in a line; the title of the file says it.
    #[serde(skip)]
    pub headline: String,
    /// What screened and what decided, in a sentence; empty where nothing was searched for.
    pub models: String,
    pub stage: Stage,
    /// The measured quantity over time, where that is not the distance from the goal.
    pub measure: Option<Measure>,
    pub tools: Vec<Tool>,
    /// Best first; at least one.
    pub plans: Vec<Plan>,
    /// Names of the columns of [`Plan::cells`].
    pub columns: Vec<&'static str>,
    /// The tools that were offered, the chosen one first.
    pub choice: Vec<Choice>,
    pub candidates: Option<Candidates>,
    /// Of a run: its pushes, and what was believed meanwhile.
    pub run: Option<Run>,
    /// What lowers the trust in all this, a line each.
    pub warnings: Vec<String>,
    pub file: File,
    /// A drawing as SVG, in place of the table from above.
    #[serde(skip)]
    pub drawing: Option<String>,
}

/// What is on the table, and what must come where.
#[derive(Serialize)]
pub struct Stage {
    pub objects: Vec<Body>,
    pub obstacles: Vec<Body>,
    /// What is to be kept out of.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<Body>,
    /// Middle and full extents of a table that ends.
    pub table: Option<[[i64; 2]; 2]>,
    /// Smallest and largest.
    pub reach: Vec<i64>,
    /// All goals; a recording has none.
    pub goals: Vec<Goal>,
}

/// What is measured over time.
#[derive(Serialize)]
pub struct Measure {
    pub name: &'static str,
    /// The same with its unit.
    pub axis: &'static str,
}

#[derive(Serialize)]
pub struct Body {
    pub name: String,
    pub shape: Outline,
    pub height: i64,
    /// Height of the underside above where it stands.
    #[serde(skip_serializing_if = "is_zero")]
    pub under: i64,
    /// What is fixed on it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub more: Vec<Body>,
    /// Where it stands at the start.
    pub at: [i64; 3],
}

fn is_zero(value: &i64) -> bool {
    *value == 0
}

/// What a body covers on the table, in its own frame.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outline {
    /// A disc of this radius.
    Disc(i64),
    /// Corners in order.
    Polygon(Vec<[i64; 2]>),
}

#[derive(Serialize)]
pub struct Goal {
    /// Indices of the objects that it may move, its own first.
    pub objects: Vec<usize>,
    pub at: [i64; 2],
    /// Zero where no place is asked for, and for a region.
    pub tolerance: i64,
    /// Regions that a centre must be in, or must leave.
    pub areas: Vec<Area>,
    /// Wanted heading and its tolerance, where one is asked for.
    pub heading: Option<[i64; 2]>,
    /// Headings are told from those a full turn away by being nearest to this one, where a joint has limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub middle: Option<i64>,
    /// Into how many equal turns a full turn falls after each of which the object looks the same.
    pub alike: usize,
    /// The same in words.
    pub words: String,
}

/// A region of a goal.
#[derive(Serialize)]
pub struct Area {
    pub shape: Outline,
    pub at: [i64; 3],
    /// `true` if a centre must leave it.
    pub leave: bool,
}

#[derive(Serialize)]
pub struct Tool {
    pub name: String,
    pub parts: Vec<Body>,
    /// The end effector in the tool frame.
    pub grip: [i64; 3],
    /// As in its file.
    pub file: Json,
}

/// How good a plan is, in a word.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Standing {
    Passed,
    Fragile,
    Failed,
    /// Not replayed, or nobody asked.
    Open,
    /// Of a run: reached as far as can be seen.
    Reached,
    /// Of a run: given up.
    GivenUp,
    /// Of a recording: it was watched.
    Inferred,
}

#[derive(Serialize)]
pub struct Plan {
    /// Index of the first tool.
    pub tool: usize,
    /// Indices of all of them.
    pub tools: Vec<usize>,
    /// What it is, in a line.
    pub name: String,
    pub standing: Standing,
    /// The verdict, in a line.
    pub verdict: String,
    /// Its row in the table of plans.
    pub cells: Vec<String>,
    pub strokes: Vec<Stroke>,
    /// Height of the tool's underside.
    pub lift: i64,
    /// The hand at the grip.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hand: Option<Body>,
    pub replays: Vec<Replay>,
    /// Where the goal's object ended in the disturbed replays.
    pub ends: Vec<End>,
    /// The command that makes these replays again; empty where none can.
    pub command: String,
    /// The script that does; empty where none can.
    pub python: String,
    /// As in its file.
    pub file: Json,
}

#[derive(Serialize)]
pub struct Stroke {
    /// Index of the tool.
    pub tool: usize,
    /// Pose of the tool frame at the start and at the end.
    pub from: [i64; 3],
    pub to: [i64; 3],
    /// Whether the tool comes down for it, from anywhere.
    pub lowered: bool,
}

/// The source of a replay or a prediction.
#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Layer {
    Predicted,
    Planar,
    Spatial,
    /// What was seen of a world.
    Seen,
    /// What really happened in a simulated one.
    Real,
}

/// A trajectory, column by column. A column holds its first value and then differences; one that
/// never changes holds one value. Poses have three: x, y and heading; those in space eight: z and the
/// quaternion x, y, z, w of the turn, too.
#[derive(Serialize)]
pub struct Replay {
    pub layer: Layer,
    /// Name of what computed it.
    pub by: String,
    /// Whether the goal is reached at the end, and nothing went wrong on the way.
    pub reached: bool,
    pub time: Vec<i64>,
    /// Index of the first frame of every stroke.
    pub strokes: Vec<usize>,
    pub tool: Vec<Vec<i64>>,
    pub objects: Vec<Vec<Vec<i64>>>,
    /// What is measured, frame by frame, see [`Data::measure`].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub measure: Vec<i64>,
    /// Of every frame the relations that the network reads: two nodes, and the kind. Nodes are objects,
    /// the parts of the tool and obstacles; kinds are contact, fixed, revolute and prismatic.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub graph: Vec<Vec<[usize; 3]>>,
}

#[derive(Serialize)]
pub struct End {
    pub layer: Layer,
    pub at: [i64; 2],
    pub reached: bool,
}

/// A tool, and why it was or was not chosen.
#[derive(Serialize)]
pub struct Choice {
    pub tool: String,
    /// Pushes that were considered with it.
    pub considered: usize,
    /// How many of those could not be made.
    pub refused: usize,
    /// The best that is predicted for it, in units of the tolerance.
    pub best: String,
    pub why: String,
    /// Index of its best plan, if one is on the page.
    pub plan: Option<usize>,
}

/// Every way to push that the search considered.
#[derive(Serialize)]
pub struct Candidates {
    /// Why pushes could not be made; cells name them by index.
    pub reasons: Vec<String>,
    pub grids: Vec<Grid>,
    /// How many there were, and how many of them are on the page.
    pub considered: usize,
    pub shown: usize,
}

/// The ways to push with one tool, held one way, as the last of a number of pushes.
#[derive(Serialize)]
pub struct Grid {
    /// Name of the tool.
    pub tool: String,
    pub pushes: usize,
    /// Grip yaw in degrees.
    pub yaw: String,
    /// Name of the part that makes contact, over a number of cells of a row; empty where a push
    /// goes on from where the last one ended.
    pub faces: Vec<(String, usize)>,
    /// Headings of the rows, degrees.
    pub directions: Vec<f64>,
    /// Row by row: lateral offset in millimetres.
    pub offsets: Vec<i64>,
    /// Row by row: see [`Grid::NOT_TRIED`].
    pub cells: Vec<i64>,
}

impl Grid {
    /// Of a cell that was neither rolled out nor refused. Otherwise a cell holds the score in
    /// hundredths of the tolerance, or the index of why it cannot be made, less [`Grid::REFUSED`].
    pub const NOT_TRIED: i64 = -1;
    /// Of a cell such that something cannot pass.
    pub const BLOCKED: i64 = -2;
    /// Of a cell that cannot be made for the first reason; those of the others follow downwards.
    pub const REFUSED: i64 = -10;
}

/// The pushes of a run or a recording, and what was believed meanwhile.
#[derive(Serialize)]
pub struct Run {
    /// What it is, in a word.
    pub kind: &'static str,
    /// When beliefs change, in a sentence.
    pub words: &'static str,
    /// What is known in the end.
    pub found: Vec<Found>,
    /// Names of the columns of [`Made::cells`].
    pub columns: Vec<String>,
    /// Which of them hold numbers.
    pub numeric: Vec<bool>,
    pub made: Vec<Made>,
    /// When what is believed changes, the start first.
    pub times: Vec<i64>,
    /// Names of the types of joints.
    pub types: Vec<String>,
    pub joints: Vec<Joined>,
    pub numbers: Vec<Believed>,
}

/// A table of what is known in the end.
#[derive(Serialize)]
pub struct Found {
    pub title: String,
    pub columns: Vec<String>,
    /// Which of them hold numbers.
    pub numeric: Vec<bool>,
    pub rows: Vec<Vec<String>>,
}

/// What was pushed in one go.
#[derive(Serialize)]
pub struct Made {
    /// When it begins.
    pub at: i64,
    pub cells: Vec<String>,
}

/// What is believed about the joint of two objects.
#[derive(Serialize)]
pub struct Joined {
    pub name: String,
    /// At each of [`Run::times`] the probabilities of the types, in thousandths.
    pub shares: Vec<[i64; 4]>,
    /// Index of the true type, where that is known.
    pub really: Option<usize>,
}

/// What is believed of a number.
#[derive(Serialize)]
pub struct Believed {
    pub name: String,
    pub unit: &'static str,
    /// At each of [`Run::times`] mean and standard deviation, in thousandths.
    pub values: Vec<[i64; 2]>,
    /// The true value, where that is known.
    pub really: Option<i64>,
}

/// What plan files on the page share.
#[derive(Serialize)]
pub struct File {
    pub schema_version: u32,
    pub task: Json,
}
