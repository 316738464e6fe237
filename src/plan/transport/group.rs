//! Groups of solids that one push carries, and the holds of a tool behind them.

use crate::geometry::{Footprint, Grid, Pose, Vector, perpendicular};
use crate::{
    scene::{Mover, Region, Scene, Situation, State},
    task::{Demand, End, Goal},
};

use super::lattice::{Extent, Shift, Solid};
use super::tool_solids::tool_solids;
use crate::plan::{CandidatePush, SET_DOWN_CLEARANCE, Start, Workspace};

/// Clearance between a carried object and fixed bodies, metres: the error of an object after two
/// pushes.
const APART: f64 = 0.003;

/// Clearance that counts as ample, metres.
pub(super) const ROOMY: f64 = 0.03;

/// Margin of the grid around all bodies and goals, metres.
const BORDER: f64 = 0.2;

/// Tolerance for rounding, metres.
const SLACK: f64 = 1e-6;

/// Offsets tried, as shares of the largest one.
const OFFSETS: [f64; 5] = [0.0, 0.35, -0.35, 0.7, -0.7];

/// Maximum number of holds for one direction.
const HOLDS: usize = 6;

/// Distance below which two holds count as one, metres.
const SAME_HOLD: f64 = 0.015;

/// Additional clearance between the tool and the object where the tool is set down, metres.
const ROOM: f64 = 0.005;

/// Largest distance of an object's centre beyond the edge of the face, relative to its mean radius.
/// A push farther out rotates the object.
const BESIDE: f64 = 0.25;

/// Share of a goal's tolerance within which a place counts as the goal.
const AT_GOAL: f64 = 0.5;

/// Group of solids that one push carries along.
pub(super) struct Group {
    pub thing: usize,
    pub solids: Vec<Solid>,
    /// Lowest and highest coordinates of the solids along both axes, relative to the position.
    pub widths: [[f64; 2]; 2],
    /// Centre of mass relative to the position.
    pub centre: Vector,
    pub lattice: Grid,
    /// Goal position and its tolerance, metres.
    pub goal: Option<(Vector, f64)>,
    /// Displacement nearest to the goal.
    pub goal_shift: Option<Shift>,
    /// Gap to fixed bodies for every place, at most [`ROOMY`]; negative if the group cannot be
    /// there.
    pub clear: Vec<f32>,
}

impl Group {
    /// Returns the place of a displacement, if it is inside the grid.
    pub fn place(&self, at: Shift) -> Option<usize> {
        self.lattice.at(at.map(i32::from))
    }

    /// Returns the position at a displacement, metres.
    pub fn position(&self, at: Shift) -> Vector {
        let offset = Vector::new(f64::from(at[0]), f64::from(at[1]));
        self.lattice.origin + offset * self.lattice.spacing
    }

    /// Returns `true` if the group can be at a displacement.
    pub fn is_clear(&self, at: Shift) -> bool {
        self.place(at).is_some_and(|place| self.clear[place] >= 0.0)
    }

    /// Returns `true` if a displacement is at the goal, or if there is no goal.
    pub fn is_at_goal(&self, at: Shift) -> bool {
        let Some((goal, tolerance)) = self.goal else { return true };
        self.goal_shift == Some(at) || (self.position(at) - goal).norm() <= AT_GOAL * tolerance
    }
}

/// Position of a tool behind a group.
pub(super) struct Hold {
    /// Index of the grip.
    pub grip: usize,
    /// Direction of the push, radians from world +x.
    pub direction: f64,
    pub step: [i32; 2],
    /// Position of the end effector relative to the group, metres.
    pub effector: Vector,
    /// Travel of the tool before it meets the group, metres.
    pub approach: f64,
}

impl Hold {
    /// Returns the direction of the push.
    pub fn ahead(&self) -> Vector {
        Vector::new(f64::from(self.step[0]), f64::from(self.step[1]))
    }
}

/// Returns all groups that can be carried from `situation`; `None` if a goal requires more than a
/// change of position.
pub(super) fn groups(workspace: &Workspace, situation: &Situation) -> Option<Vec<Group>> {
    let (task, state) = (workspace.task, &situation.start);
    let scene = &*situation.scene;
    let goals: Vec<&Goal> = task.goals.iter().collect();
    let groups = situation.physics.groups(|_| true);
    let joined = |thing: usize| {
        (0..groups.len()).any(|k| groups[k] == groups[thing] && scene.thing(k) != thing)
            || scene.mount(thing).is_some()
    };
    let loose: Vec<usize> = scene
        .things()
        .map(|(k, _)| k)
        .filter(|&k| !joined(k) && scene.objects[k].keep.is_none())
        .collect();
    for goal in &goals {
        let end = End::resting(goal.object, state);
        let turned = goal.demands.iter().map(Demand::kind).any(|kind| {
            let turn = kind.turned(&end).zip(kind.turn_tolerance());
            turn.is_some_and(|(turn, tolerance)| turn.abs() > tolerance)
        });
        let places = goal.demands.iter().filter(|demand| demand.kind().tolerance().is_some());
        if turned || places.count() != 1 || goal.is_relation() || !loose.contains(&goal.object) {
            return None;
        }
    }
    let mut extent = Extent::around(state.poses[task.goals[0].object].position);
    let mut include = |footprint: &Footprint, pose: &Pose| {
        let wide = |axis: Vector| footprint.extent(pose.local_vector(axis)) + BORDER;
        let [x, y] = [Vector::x(), Vector::y()];
        extent.include(pose.position - Vector::new(wide(-x), wide(-y)));
        extent.include(pose.position + Vector::new(wide(x), wide(y)));
    };
    for (object, pose) in scene.objects.iter().zip(&state.poses) {
        include(&object.shape.footprint(), pose);
    }
    scene.obstacles.iter().for_each(|o| include(&o.shape().footprint(), &o.pose));
    for goal in &goals {
        include(
            &task.scene.objects[goal.object].shape.footprint(),
            &Pose { position: goal.place(state), heading: 0.0 },
        );
    }
    let reach = task.robot.reach_max + BORDER;
    let [low, high] = [extent.low, extent.high].map(|p| p.map(|v| v.clamp(-reach, reach)));
    let extent = Extent { low, high };
    let spacing = extent.spacing();
    let group = |&thing: &usize| {
        let at: Vector = state.poses[thing].position;
        let solids = solids_of(scene, state, thing);
        let lattice = extent.grid(at, spacing);
        let own = goals.iter().find(|goal| goal.object == thing);
        let goal = own.map(|goal| {
            let at = if goal.reached(state) { at } else { goal.place(state) };
            (at, goal.tolerance())
        });
        let shift = |(goal, _)| lattice.offset(lattice.nearest(goal)).map(|v| v as i16);
        let clear = clear(scene, (state, &loose), (thing, &solids), &lattice);
        let width = |axis: Vector| {
            let far = |one: &Solid, axis: Vector| {
                one.pose.position.dot(&axis) + one.footprint.extent(one.pose.local_vector(axis))
            };
            let most = |axis| solids.iter().map(|one| far(one, axis)).fold(f64::MIN, f64::max);
            [-most(-axis), most(axis)]
        };
        let widths = [width(Vector::x()), width(Vector::y())];
        let centre = scene.centre(thing, state) - at;
        Group { thing, widths, centre, goal, goal_shift: goal.map(shift), clear, solids, lattice }
    };
    Some(loose.iter().map(group).collect())
}

/// Returns the solids of an object relative to its position.
fn solids_of(scene: &Scene, state: &State, thing: usize) -> Vec<Solid> {
    let at = state.poses[thing].position;
    let solid = |k: usize| {
        let (object, pose) = (&scene.objects[k], state.poses[k]);
        Solid {
            footprint: object.shape.footprint(),
            pose: Pose { position: pose.position - at, ..pose },
            span: object.span(),
            apart: APART,
        }
    };
    [thing].into_iter().chain(scene.parts_of(thing)).map(solid).collect()
}

/// Returns the clearance of an object at every place from obstacles, keep-out regions for objects
/// and objects that cannot be carried.
fn clear(
    scene: &Scene,
    (state, loose): (&State, &[usize]),
    (thing, solids): (usize, &[Solid]),
    lattice: &Grid,
) -> Vec<f32> {
    let mut clear = vec![ROOMY as f32; lattice.count()];
    let here = lattice.position(lattice.nearest(state.poses[thing].position));
    for solid in solids {
        let mut keep = |footprint: Footprint, pose: Pose, apart: f64| {
            let still = (&footprint, &pose);
            // An object that starts nearer may slide along.
            let apart = apart.min(solid.gap(here, still, ROOMY) - SLACK);
            solid.near(lattice, still, ROOMY, |place, gap| {
                let gap = if gap < apart { -1.0 } else { gap.max(0.0) };
                clear[place] = clear[place].min(gap as f32);
            });
        };
        for obstacle in scene.obstacles.iter().filter(|o| o.meets(solid.span)) {
            keep(obstacle.shape().footprint(), obstacle.pose, solid.apart);
        }
        for region in scene.keep_out.iter().filter(|region| region.objects) {
            keep(region.footprint(), region.pose, Region::MARGIN);
        }
        for (k, object) in scene.objects.iter().enumerate() {
            if !loose.contains(&scene.thing(k)) && object.meets(solid.span) {
                keep(object.shape.footprint(), state.poses[k], solid.apart);
            }
        }
    }
    if let Some(top) = scene.table_top {
        for (place, clear) in clear.iter_mut().enumerate() {
            if !top.holds(lattice.position(place)) {
                *clear = -1.0;
            }
        }
    }
    clear
}

/// Returns the columns and rows of a step along a heading (radians), and its direction; `None`
/// without a neighbour there.
pub(super) fn step_of(heading: f64) -> Option<([i32; 2], Vector)> {
    let ahead = Vector::new(heading.cos(), heading.sin());
    let step = [ahead.x.round() as i32, ahead.y.round() as i32];
    let off = ahead - Vector::new(f64::from(step[0]), f64::from(step[1]));
    (off.norm() <= SLACK).then_some((step, ahead))
}

/// Returns the holds of a tool with one grip yaw behind a group, for every direction.
pub(super) fn holds(
    workspace: &Workspace,
    (grip, pair): (usize, (usize, f64)),
    situation: &Situation,
    group: &Group,
) -> Vec<Hold> {
    let (task, scene, state) = (workspace.task, &*situation.scene, &situation.start);
    let centre = scene.centre(group.thing, state);
    let at = state.poses[group.thing].position;
    let mut found = Vec::new();
    for direction in task.pushes.directions.headings() {
        let Some((step, ahead)) = step_of(direction) else { continue };
        let left = perpendicular(ahead);
        let mut ways: Vec<(f64, Vector, f64)> = Vec::new();
        for object in [group.thing].into_iter().chain(scene.parts_of(group.thing)) {
            for (part, face) in workspace.tools[pair.0].parts().iter().enumerate() {
                let span = workspace.offset_span(pair, (state, object), part, direction);
                let tool = workspace.tools[pair.0].pose(Pose::new(0.0, 0.0, pair.1));
                let across = (tool * face.pose).local_vector(left);
                let half = face.footprint().extent(across).max(face.footprint().extent(-across));
                let radius = scene.objects[object].shape.footprint().mean_radius();
                let (shape, pose) = (&scene.objects[object].shape, state.poses[object]);
                let wide = |axis: Vector| shape.footprint().extent(pose.local_vector(axis));
                // With a side of the object flush with a side of the face, both fit a passage.
                let flush = (half - wide(left).max(wide(-left))).abs().min(span);
                let offsets = OFFSETS.map(|share| share * span);
                for offset in offsets.into_iter().chain([flush, -flush]) {
                    let start = Start::Placed { part, offset };
                    let ((tool, grip_yaw), length, room) = (pair, 0.0, ROOM);
                    let push =
                        CandidatePush { tool, grip_yaw, object, start, direction, length, room };
                    // Lateral offset of the object's centre from the middle of the face.
                    let past = offset + (centre - state.poses[object].position).dot(&left);
                    let Ok(placement) = workspace.place(state, &push, None) else { continue };
                    if past.abs() < half + BESIDE * radius {
                        ways.push((past.abs(), placement.start - at, placement.approach()));
                    }
                }
            }
        }
        ways.sort_by(|a, b| a.0.total_cmp(&b.0));
        let first = found.len();
        let mut taken: Vec<Vector> = Vec::new();
        for (_, effector, approach) in ways {
            let known = taken.iter().any(|other| (other - effector).norm() < SAME_HOLD);
            if known || found.len() - first == HOLDS {
                continue;
            }
            taken.push(effector);
            let own = |(solid, _): &(Solid, Mover)| {
                group.solids.iter().all(|other| {
                    let still = (&other.footprint, &other.pose);
                    !solid.meets(other) || solid.gap(effector, still, ROOMY) >= SET_DOWN_CLEARANCE
                })
            };
            if tool_solids(workspace, pair).all(|one| own(&one)) {
                found.push(Hold { grip, direction, step, effector, approach });
            }
        }
    }
    found
}
