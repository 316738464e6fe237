//! Data of a plan page, in the format of its script and in its [units](super::units).

use serde::Serialize;
use serde_json::Value as Json;

mod run;

pub use run::{Believed, Found, Joined, Made, Run};

pub use super::units::{fine, length, point, pose};

/// Data of a whole page.
#[derive(Serialize)]
pub struct Data {
    /// Name of the task.
    pub task: String,
    /// The task's description.
    pub description: String,
    /// Outcome in one line, also part of the file's title.
    #[serde(skip)]
    pub headline: String,
    /// Model in a sentence; empty without a search.
    pub models: String,
    pub stage: Stage,
    /// Quantity plotted over time, if it is not the distance from the goal.
    pub measure: Option<Measure>,
    pub tools: Vec<Tool>,
    /// Plans, best first; at least one.
    pub plans: Vec<Plan>,
    /// Names of the columns of [`Plan::cells`].
    pub columns: Vec<&'static str>,
    /// Offered tools, the chosen one first.
    pub choice: Vec<Choice>,
    pub candidates: Option<Candidates>,
    /// Further results, above the other tables.
    pub found: Vec<Found>,
    /// Pushes of a run and the belief over time.
    pub run: Option<Run>,
    /// Warnings, a line each.
    pub warnings: Vec<String>,
    pub file: File,
    /// Drawing as SVG, in place of the top view.
    #[serde(skip)]
    pub drawing: Option<String>,
}

/// Scene and goals.
#[derive(Serialize)]
pub struct Stage {
    pub objects: Vec<Body>,
    pub obstacles: Vec<Body>,
    /// Keep-out regions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<Body>,
    /// Centre and full extents of a finite table.
    pub table: Option<[[i64; 2]; 2]>,
    /// Smallest and largest reach.
    pub reach: Vec<i64>,
    /// Centre of the reach, unless it is the origin.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base: Option<[i64; 2]>,
    /// Goals; empty for a recording.
    pub goals: Vec<Goal>,
}

/// Quantity plotted over time.
#[derive(Serialize)]
pub struct Measure {
    pub name: &'static str,
    /// Name with unit, for the axis.
    pub axis: &'static str,
}

#[derive(Serialize)]
pub struct Body {
    pub name: String,
    pub shape: Outline,
    pub height: i64,
    /// Height of the underside above the body's origin.
    #[serde(skip_serializing_if = "is_zero")]
    pub under: i64,
    /// Whether it is the robot's base.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub base: bool,
    /// Index of the object of which it is a part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub whole: Option<usize>,
    /// Solids fixed to this body.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub more: Vec<Body>,
    /// Pose at the start.
    pub at: [i64; 3],
}

fn is_zero(value: &i64) -> bool {
    *value == 0
}

/// Footprint of a body, in its own frame.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outline {
    /// Disc of this radius.
    Disc(i64),
    /// Polygon, corners in order.
    Polygon(Vec<[i64; 2]>),
}

#[derive(Serialize)]
pub struct Goal {
    /// Indices of the objects that the goal may move, its own first.
    pub objects: Vec<usize>,
    pub at: [i64; 2],
    /// Whether `at` is no wanted position but the start of the object.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub unplaced: bool,
    /// Position tolerance; zero for a region and for a goal without a position.
    pub tolerance: i64,
    /// Regions that a centre must enter or leave.
    pub areas: Vec<Area>,
    /// Distances from other bodies within which the outline must come.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bands: Vec<Band>,
    /// Outlines that must be covered, corners of polygons.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub covers: Vec<Vec<[i64; 2]>>,
    /// Parts of edges of the table that must be crossed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edges: Vec<[[i64; 2]; 2]>,
    /// Way about a hinge, if one holds the object.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arc: Option<Arc>,
    /// Wanted heading and its tolerance, if the goal has one.
    pub heading: Option<[i64; 2]>,
    /// Midpoint of the joint limits, used to unwrap headings to the nearest turn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub middle: Option<i64>,
    /// Order of the object's rotational symmetry.
    pub alike: usize,
    /// Goal in words.
    pub words: String,
}

/// Region of a goal.
#[derive(Serialize)]
pub struct Area {
    pub shape: Outline,
    pub at: [i64; 3],
    /// Whether a centre must leave the region.
    pub leave: bool,
}

/// Way of a hinged object's far end.
#[derive(Serialize)]
pub struct Arc {
    /// Position of the hinge.
    pub centre: [i64; 2],
    pub radius: i64,
    /// Angle at the start and wanted angle, seen from the hinge.
    pub from: i64,
    pub to: i64,
    /// Largest rotation from the wanted angle.
    pub tolerance: i64,
}

/// Distances from a body.
#[derive(Serialize)]
pub struct Band {
    /// Corners of the body's polygons.
    pub pieces: Vec<Vec<[i64; 2]>>,
    pub from: i64,
    pub to: i64,
}

#[derive(Serialize)]
pub struct Tool {
    pub name: String,
    pub parts: Vec<Body>,
    /// Pose of the end effector in the tool frame.
    pub grip: [i64; 3],
    /// Tool as in its file.
    pub file: Json,
}

/// Status of a plan, in one word.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Standing {
    Passed,
    Fragile,
    Failed,
    /// Not replayed.
    Open,
    /// Run: goal reached according to the observations.
    Reached,
    /// Run: given up.
    GivenUp,
    /// Recording: observed.
    Inferred,
}

#[derive(Serialize)]
pub struct Plan {
    /// Index of the first tool.
    pub tool: usize,
    /// Indices of all tools.
    pub tools: Vec<usize>,
    /// Description, in one line.
    pub name: String,
    pub standing: Standing,
    /// Verdict, in one line.
    pub verdict: String,
    /// Row in the table of plans.
    pub cells: Vec<String>,
    pub strokes: Vec<Stroke>,
    /// Height of the tool's underside.
    pub lift: i64,
    /// Hand at the grip.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hand: Option<Body>,
    pub replays: Vec<Replay>,
    /// Final positions of the goal's object in the perturbed replays.
    pub ends: Vec<End>,
    /// Command that repeats these replays; empty if there is none.
    pub command: String,
    /// Script that repeats these replays; empty if there is none.
    pub python: String,
    /// Plan as in its file.
    pub file: Json,
}

#[derive(Serialize)]
pub struct Stroke {
    /// Index of the tool.
    pub tool: usize,
    /// Pose of the tool frame at the start and at the end.
    pub from: [i64; 3],
    pub to: [i64; 3],
    /// Whether the tool is lowered for this stroke, from an arbitrary position.
    pub lowered: bool,
}

/// Source of a replay or a prediction.
#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Layer {
    Predicted,
    Planar,
    Spatial,
    /// Observation of a world.
    Seen,
    /// Ground truth of a simulated world.
    Real,
}

/// Trajectory, column by column.
///
/// A column holds its first value, then differences; a constant column holds one value. Planar
/// poses have three columns: x, y and heading. 3-D poses have eight: the planar ones, z, and the
/// quaternion x, y, z, w of the rotation.
#[derive(Serialize)]
pub struct Replay {
    pub layer: Layer,
    /// Name of the model or engine.
    pub by: String,
    /// Whether the goal is reached at the end, without a failure during execution.
    pub reached: bool,
    pub time: Vec<i64>,
    /// Index of the first frame of every stroke.
    pub strokes: Vec<usize>,
    pub tool: Vec<Vec<i64>>,
    pub objects: Vec<Vec<Vec<i64>>>,
    /// Measured quantity, frame by frame, see [`Data::measure`].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub measure: Vec<i64>,
    /// Relations that the network receives in every frame: two nodes and the kind. Nodes are
    /// objects, tool parts and obstacles; kinds are contact, fixed, revolute and prismatic.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub graph: Vec<Vec<[usize; 3]>>,
}

#[derive(Serialize)]
pub struct End {
    pub layer: Layer,
    pub at: [i64; 2],
    pub reached: bool,
}

/// A tool, and the reason why it was chosen or rejected.
#[derive(Serialize)]
pub struct Choice {
    pub tool: String,
    /// Number of pushes considered with this tool.
    pub considered: usize,
    /// Number of considered pushes that are infeasible.
    pub refused: usize,
    /// Best predicted score, in units of the tolerance.
    pub best: String,
    pub why: String,
    /// Index of the tool's best plan, if one is on the page.
    pub plan: Option<usize>,
}

/// Pushes considered by the search.
#[derive(Serialize)]
pub struct Candidates {
    /// Reasons for infeasible pushes; cells refer to them by index.
    pub reasons: Vec<String>,
    pub grids: Vec<Grid>,
    /// Number of considered pushes, and number of pushes on the page.
    pub considered: usize,
    pub shown: usize,
}

/// Pushes considered as the last of a sequence, with one tool and one grip.
#[derive(Serialize)]
pub struct Grid {
    /// Name of the tool.
    pub tool: String,
    pub pushes: usize,
    /// Grip yaw in degrees.
    pub yaw: String,
    /// Name of the contacting part and the number of cells that it spans in a row. The name is
    /// empty for a push that continues from the end of the last one.
    pub faces: Vec<(String, usize)>,
    /// Headings of the rows, degrees.
    pub directions: Vec<f64>,
    /// Lateral offset in millimetres, row by row.
    pub offsets: Vec<i64>,
    /// Result, row by row; see [`Grid::NOT_TRIED`].
    pub cells: Vec<i64>,
}

impl Grid {
    /// Value of a cell that was neither rolled out nor rejected.
    ///
    /// Other cells hold the score in hundredths of the tolerance, or, if infeasible, the index
    /// of the reason, counted down from [`Grid::REFUSED`].
    pub const NOT_TRIED: i64 = -1;
    /// Value of a cell whose push is obstructed.
    pub const BLOCKED: i64 = -2;
    /// Value of an infeasible cell with the first reason; further reasons follow downwards.
    pub const REFUSED: i64 = -10;
}

/// Common content of the plan files on the page.
#[derive(Serialize)]
pub struct File {
    pub schema_version: u32,
    pub task: Json,
}
