//! What an arm with a tool runs into: itself, the table, and what stands there.

use super::hull::{Hull, PlacedHull};
use super::model::Arm;
use pushplan::geometry::{Pose3, Vector3};
use pushplan::scene::{Object, Robot, Scene, State, Tool};

use super::inverse::start;
use super::kinematics::{flange, frames};

/// An arm keeps this far from all that stands there, metres; from itself it must only be apart.
const APART: f64 = 0.002;

/// Postures in which it is looked at which bodies are in each other, and in what share of them that is
/// how they are built.
const POSTURES: usize = 100;
const OFTEN: f64 = 0.2;

/// What the tool is called.
const TOOL: &str = "tool";

/// The pairs of bodies of an arm that could come to each other: no neighbours, and not in each other as
/// often as the convex solids of a bent wrist are, nor at home.
pub fn pairs(arm: &Arm) -> Vec<[usize; 2]> {
    let room = Room::empty(arm);
    let stances: Vec<Stance> = (0..POSTURES).map(|k| room.stance(&start(arm, k))).collect();
    let home = room.stance(&arm.home);
    let count = arm.bodies.len();
    let all = (0..count).flat_map(|first| (first + 2..count).map(move |second| [first, second]));
    let apart = |[a, b]: &[usize; 2]| {
        let touch = |stance: &Stance| touching(&stance.bodies[*a], &stance.bodies[*b], 0.0);
        let often = stances.iter().filter(|stance| touch(stance) == Some(true)).count();
        touch(&home) == Some(false) && often as f64 <= OFTEN * POSTURES as f64
    };
    all.filter(apart).collect()
}

/// The first body of an arm that can come to the table: those before it stand there.
pub fn above(arm: &Arm) -> usize {
    let home = Room::empty(arm).stance(&arm.home);
    let count = arm.bodies.len();
    let low = |body: &Vec<PlacedHull>| body.iter().any(|hull| hull.lowest() <= APART);
    (1..count).find(|k| !low(&home.bodies[*k])).unwrap_or(count)
}

/// What an arm may run into.
pub(super) struct Room<'a> {
    pub arm: &'a Arm,
    /// The first body that can come to the table.
    above: usize,
    /// The tool's parts, seen from the flange.
    tool: Vec<Hull>,
    /// Obstacles, without what the arm stands on.
    obstacles: Vec<(&'a str, PlacedHull)>,
    /// Objects at their turn, with their heights.
    objects: Vec<(&'a str, Hull)>,
}

/// The arm at some joint positions.
pub(super) struct Stance {
    bodies: Vec<Vec<PlacedHull>>,
    tool: Vec<PlacedHull>,
}

impl<'a> Room<'a> {
    pub fn new(arm: &'a Arm, scene: &'a Scene, tool: Option<&Tool>) -> Self {
        let flat = |pose, height| Pose3::upright(pose, height);
        let upright =
            |one: &Object| Hull::prism(&one.shape.footprint(), one.span(), &Pose3::default());
        let obstacles = scene.obstacles.iter().filter(|one| one.name != Robot::BASE);
        let obstacles = obstacles.map(|one| {
            let half = 0.5 * Vector3::from(one.size);
            let hull = Hull::cuboid(half, &Pose3::default());
            (&*one.name, hull.placed(&flat(one.pose, one.z + half.z)))
        });
        Self {
            arm,
            above: above(arm),
            tool: tool.map(|tool| of_tool(arm, tool)).unwrap_or_default(),
            obstacles: obstacles.collect(),
            objects: scene.objects.iter().map(|one| (&*one.name, upright(one))).collect(),
        }
    }

    /// An arm without anything around it.
    fn empty(arm: &'a Arm) -> Self {
        let (tool, obstacles, objects) = (Vec::new(), Vec::new(), Vec::new());
        Self { arm, above: 1, tool, obstacles, objects }
    }

    /// The arm at some joint positions.
    pub fn stance(&self, positions: &[f64]) -> Stance {
        let frames = frames(self.arm, positions);
        let bodies = self
            .arm
            .bodies
            .iter()
            .zip(&frames)
            .map(|(body, frame)| body.solids.iter().map(|hull| hull.placed(frame)).collect());
        let flange = flange(self.arm, &frames);
        Stance {
            bodies: bodies.collect(),
            tool: self.tool.iter().map(|hull| hull.placed(&flange)).collect(),
        }
    }

    /// Objects where they are in a state.
    pub fn objects(&self, state: &State) -> Vec<(&'a str, PlacedHull)> {
        let placed = self.objects.iter().zip(&state.poses);
        placed
            .map(|((name, hull), pose)| (*name, hull.placed(&Pose3::upright(*pose, 0.0))))
            .collect()
    }

    /// Which two things are in each other, if any: the arm's own, the arm and the table, obstacles or
    /// `objects`; of the tool too where it is `carried`, and not where it pushes.
    pub fn met(
        &self,
        stance: &Stance,
        objects: &[(&str, PlacedHull)],
        carried: bool,
    ) -> Option<[String; 2]> {
        let name = |k: usize| self.arm.bodies[k].name.clone();
        for [a, b] in &self.arm.pairs {
            if touching(&stance.bodies[*a], &stance.bodies[*b], 0.0) == Some(true) {
                return Some([name(*a), name(*b)]);
            }
        }
        let last = stance.bodies.len().saturating_sub(2);
        for (k, body) in stance.bodies.iter().enumerate() {
            // What holds the tool is near it however it moves.
            if k < last && touching(body, &stance.tool, 0.0) == Some(true) {
                return Some([name(k), TOOL.into()]);
            }
            if k >= self.above && body.iter().any(|hull| hull.lowest() < APART) {
                return Some([name(k), "table".into()]);
            }
            // The base does not move: what stands next to it stands there.
            if k > 0
                && let Some(other) = first_met(body, self.obstacles.iter().chain(objects))
            {
                return Some([name(k), other]);
            }
        }
        if !carried {
            return None;
        }
        let mut others = self.obstacles.iter().chain(objects);
        let inside =
            |other: &PlacedHull| stance.tool.iter().any(|part| part.gap(other, 0.0) <= 0.0);
        if let Some((other, _)) = others.find(|(_, other)| inside(other)) {
            return Some([TOOL.into(), (*other).to_owned()]);
        }
        let low = |hull: &PlacedHull| hull.lowest() < -APART;
        stance.tool.iter().any(low).then(|| [TOOL.into(), "table".into()])
    }
}

fn first_met<'b>(
    body: &[PlacedHull],
    mut others: impl Iterator<Item = &'b (&'b str, PlacedHull)>,
) -> Option<String> {
    let near = |other: &PlacedHull| body.iter().any(|hull| hull.gap(other, APART) < APART);
    others.find(|(_, other)| near(other)).map(|(name, _)| (*name).to_owned())
}

/// Whether bodies are in each other; nothing of what has no solids.
fn touching(a: &[PlacedHull], b: &[PlacedHull], apart: f64) -> Option<bool> {
    let pairs = || a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
    pairs().next()?;
    Some(pairs().any(|(a, b)| a.gap(b, apart) <= apart))
}

/// The parts of a tool, seen from the flange.
fn of_tool(arm: &Arm, tool: &Tool) -> Vec<Hull> {
    let seen = arm.flange_of_tool().inverse();
    let grip = tool.grip.inverse();
    let parts = tool.parts().iter().map(|part| {
        let pose = seen * Pose3::upright(grip * part.pose, 0.0);
        Hull::prism(&part.footprint(), [0.0, part.shape.height()], &pose)
    });
    parts.collect()
}
