//! The reference layout: tools of four cuboids in seven poses, and one cylinder at 24 starts.
//!
//! The layout follows the tool experiments of Tekden et al. 2021 ("Object and relation centric
//! representations for push effect prediction", arXiv 2102.02100). Their robot's hand can also
//! touch the cylinder; ours holds the tool without a hand. They state no masses and frictions; the
//! values here are typical of a kitchen object on a wooden table.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use rand::Rng;
use serde::{Deserialize, Serialize};

use pushplan::{
    geometry::{Pose, Vector, clearance},
    scene::{Object, Part, Robot, Scene, Tool},
    seeded::generator,
    task::{Goal, PushForm, PushRules, Task},
};

/// Number of equal steps of a push after which stops are offered: 5 mm each.
pub const STEPS: usize = 40;

/// Travel of a push, metres.
pub const TRAVEL: f64 = 0.20;

/// Speed of a push, m/s.
pub const SPEED: f64 = 0.10;

/// Number of pushes of a chained sequence.
const CHAINED: usize = 3;

/// Error below which a task counts as solved, metres; the second, coarser threshold is [`COARSE`].
pub const FINE: f64 = 0.05;

/// Coarser error threshold, metres.
pub const COARSE: f64 = 0.10;

/// Growth of the tool's parts in the check that a tool pose is free at a start, metres.
const GROWN: f64 = 0.025;

/// Height of the tools' underside above the table, metres: parts are 0.05 m high with their centres
/// 0.05 m above the table.
pub const LIFT: f64 = 0.025;

/// Grid of the starts: four along x and six along y, ends included, over 0.6 x 1.0 m, centred 0.425
/// m in front of the end effector.
const GRID: (usize, usize) = (4, 6);
const GRID_CENTRE: f64 = 0.425;
const GRID_SIZE: (f64, f64) = (0.6, 1.0);

/// Half the spacing of the grid, metres.
const CELL_HALF: f64 = 0.1;

/// Seed of the scattered starts.
const SCATTER_SEED: u64 = 7;

/// Tool poses: index into [`reference_tools`], and rotation in units of 90 degrees.
const POSES: [(usize, i8); 7] = [(0, 0), (0, -1), (0, 1), (1, 0), (1, -1), (2, 0), (2, 1)];

/// Layout of the cylinder's starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Layout {
    /// Grid of the reference. Grid, tools and pushes are aligned, so that flat faces nearly always
    /// push the cylinder through its centre.
    Grid,
    /// Starts displaced at random within their own grid cells, so that corners and edges touch the
    /// cylinder too.
    Scattered,
}

impl Layout {
    /// Both layouts.
    pub const ALL: [Layout; 2] = [Layout::Grid, Layout::Scattered];

    /// Returns start number `index` of the grid in this layout, rounded to a millimetre.
    fn place(self, start: Vector, index: usize) -> Vector {
        match self {
            Layout::Grid => start,
            Layout::Scattered => {
                let mut random = generator(SCATTER_SEED, index as u64);
                let mut aside = || random.random_range(-CELL_HALF..=CELL_HALF);
                (start + Vector::new(aside(), aside())).map(|v| (v * 1e3).round() / 1e3)
            }
        }
    }
}

/// Pushes of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToolForm {
    /// Up to three consecutive pushes from a fixed home position.
    Chained,
    /// Single push from the home position, with random start and goal.
    Single,
}

impl ToolForm {
    /// Returns the largest number of pushes of a task.
    fn pushes(self) -> usize {
        match self {
            ToolForm::Chained => CHAINED,
            ToolForm::Single => 1,
        }
    }
}

/// Tool poses and starts.
#[derive(Clone, Debug)]
pub struct ReferenceSetup {
    /// Pushes of a task.
    pub form: ToolForm,
    /// Tool poses, each as a separate tool that is held without rotation: stick, L and inverse L.
    /// They are named `stick -90`, with the rotation in degrees.
    pub poses: Vec<Arc<Tool>>,
    /// Positions of the cylinder, metres.
    pub starts: Vec<Vector>,
}

impl ReferenceSetup {
    /// Returns the tools, poses and starts of a layout, for chained pushes.
    pub fn new(layout: Layout) -> Self {
        let tools = reference_tools();
        let posed = |&(tool, quarters): &(usize, i8)| {
            let tool: &Tool = &tools[tool];
            let name = format!("{} {}", tool.name, i32::from(quarters) * 90);
            // This is the pose of the end effector in the tool frame, so the rotation is inverted.
            let grip = Pose::new(0.0, 0.0, -f64::from(quarters) * FRAC_PI_2);
            Arc::new(tool.clone().named(name).held_at(grip))
        };
        let poses = POSES.iter().map(posed).collect();
        let along = |k: usize, n: usize, size: f64| size * (k as f64 / (n - 1) as f64 - 0.5);
        let starts = (0..GRID.0)
            .flat_map(|i| (0..GRID.1).map(move |j| (i, j)))
            .map(|(i, j)| {
                let x = GRID_CENTRE + along(i, GRID.0, GRID_SIZE.0);
                let start = Vector::new(x, along(j, GRID.1, GRID_SIZE.1));
                layout.place(start, i * GRID.1 + j)
            })
            .collect();
        Self { form: ToolForm::Chained, poses, starts }
    }

    /// Returns the setup for another form of pushes.
    pub fn with_form(self, form: ToolForm) -> Self {
        Self { form, ..self }
    }

    /// Returns the task of bringing the cylinder from `start` to `goal` (metres) by pushes from the
    /// home position.
    pub fn task(&self, start: Vector, goal: Vector) -> Task {
        let cylinder = Object::cylinder("cylinder", 0.05, 0.10).mass(0.5);
        let scene = Scene::new([cylinder.at(start.x, start.y, 0.0)]);
        // The end effector stays within the range of chained sequences.
        let robot = Robot::reaching(0.0, CHAINED as f64 * TRAVEL).without_body();
        Task::new("reference", scene, robot, Goal::new(0, goal.into(), FINE)).pushing(PushRules {
            form: PushForm::Chained,
            grip_yaws: vec![0.0],
            length: TRAVEL,
            speed: SPEED,
            max_count: self.form.pushes(),
            lift: LIFT,
            ..PushRules::default()
        })
    }

    /// Returns the indices of the poses that can be set down with the cylinder at `start`.
    pub fn free_poses(&self, start: Vector) -> Vec<usize> {
        let task = self.task(start, start);
        let cylinder = &task.scene.objects[0];
        let still = (&cylinder.shape.footprint(), &cylinder.pose);
        let overlaps = |tool: &Tool| {
            let frame = tool.pose(Pose { position: task.robot.home, heading: 0.0 });
            (0..tool.parts().len()).any(|k| {
                let grown = tool.parts()[k].footprint().grown(GROWN);
                clearance((&grown, &tool.part_pose(k, &frame)), still, GROWN) <= 0.0
            })
        };
        (0..self.poses.len()).filter(|&k| !overlaps(&self.poses[k])).collect()
    }

    /// Returns the index of the tool pose called `name`.
    pub fn pose(&self, name: &str) -> Option<usize> {
        self.poses.iter().position(|pose| pose.name == name)
    }
}

/// Returns the reference tools: three cuboids of 0.14 x 0.08 m in a row, centres at 0.12, 0.26 and
/// 0.40 m from the end effector, and a fourth. The fourth is another in the row at 0.54 m, or a
/// head of 0.16 x 0.08 m across.
fn reference_tools() -> Vec<Tool> {
    let handle =
        |name: &str, x: f64| Part::cuboid(name, [0.14, 0.08, 0.05], Pose::new(x, 0.0, 0.0));
    let head = |side: f64| {
        Part::cuboid("head", [0.16, 0.08, 0.05], Pose::new(0.43, 0.12 * side, FRAC_PI_2 * side))
    };
    [("stick", handle("handle-4", 0.54)), ("l", head(1.0)), ("inverse-l", head(-1.0))]
        .into_iter()
        .map(|(name, fourth)| {
            let mut parts: Vec<Part> = [("handle-1", 0.12), ("handle-2", 0.26), ("handle-3", 0.40)]
                .into_iter()
                .map(|(name, x)| handle(name, x))
                .collect();
            parts.push(fourth);
            let joints = (1..parts.len()).map(|k| [k - 1, k]).collect();
            Tool::assembled(name, parts, joints)
        })
        .collect()
}
