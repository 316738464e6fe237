//! Collisions of an arm with a tool: with itself, the table, and bodies on it.

use super::hull::{Hull, PlacedHull};
use super::model::{Arm, ArmBody};
use pushplan::geometry::{Pose3, Vector3};
use pushplan::scene::{Object, Scene, State, Tool};

use super::inverse::start;
use super::kinematics::{flange, frames};

/// Minimum distance of an arm from other bodies, metres; self-collision requires only separation.
const APART: f64 = 0.002;

/// Number of sampled configurations to detect permanent overlaps of bodies, and the share of
/// overlaps that counts as permanent.
const POSTURES: usize = 100;
const OFTEN: f64 = 0.2;

/// Name of the tool in collisions.
const TOOL: &str = "tool";

/// Returns the pairs of bodies to check for self-collision. Neighbours are excluded, and pairs that
/// overlap at home or as often as the convex solids of a bent wrist do.
pub fn pairs(arm: &Arm) -> Vec<[usize; 2]> {
    let room = Room::empty(arm);
    let stances: Vec<Stance> = (0..POSTURES).map(|k| room.stance(&start(arm, k))).collect();
    let home = room.stance(&arm.home);
    // Links beside the arm do not move, like its base.
    let [count, all] = [arm.bodies.len(), arm.links().count()];
    let apart = |second: usize| if second < count { second.saturating_sub(1) } else { count };
    let all = (0..all).flat_map(|second| {
        let first = if second < count { 0 } else { 1 };
        (first..apart(second)).map(move |first| [first, second])
    });
    let apart = |[a, b]: &[usize; 2]| {
        let touch = |stance: &Stance| touching(&stance.bodies[*a], &stance.bodies[*b], 0.0);
        let often = stances.iter().filter(|stance| touch(stance) == Some(true)).count();
        touch(&home) == Some(false) && often as f64 <= OFTEN * POSTURES as f64
    };
    all.filter(apart).collect()
}

/// Returns the index of the first body that can collide with the table; the bodies before it stand
/// on it.
pub fn above(arm: &Arm) -> usize {
    let home = Room::empty(arm).stance(&arm.home);
    let count = arm.bodies.len();
    let low = |body: &Vec<PlacedHull>| body.iter().any(|hull| hull.lowest() <= APART);
    (1..count).find(|k| !low(&home.bodies[*k])).unwrap_or(count)
}

/// Collision model of an arm and its surroundings.
pub(super) struct Room<'a> {
    pub arm: &'a Arm,
    /// Index of the first body that can collide with the table.
    above: usize,
    /// Parts of the tool in the frame of the flange.
    tool: Vec<Hull>,
    /// Obstacles, except the foot of the arm.
    obstacles: Vec<(&'a str, PlacedHull)>,
    /// Objects in their own frames.
    objects: Vec<(&'a str, Hull)>,
}

/// Placed solids of the arm and its tool.
pub(super) struct Stance {
    bodies: Vec<Vec<PlacedHull>>,
    tool: Vec<PlacedHull>,
}

impl<'a> Room<'a> {
    pub fn new(arm: &'a Arm, scene: &'a Scene, tool: Option<&Tool>) -> Self {
        let flat = |pose, height| Pose3::upright(pose, height);
        let upright =
            |one: &Object| Hull::prism(&one.shape.footprint(), one.span(), &Pose3::default());
        let obstacles = scene.obstacles.iter().filter(|one| !one.is_robot());
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

    /// Returns a collision model without tool, obstacles and objects.
    fn empty(arm: &'a Arm) -> Self {
        let (tool, obstacles, objects) = (Vec::new(), Vec::new(), Vec::new());
        Self { arm, above: 1, tool, obstacles, objects }
    }

    /// Returns the placed solids at the given joint positions.
    pub fn stance(&self, positions: &[f64]) -> Stance {
        let frames = frames(self.arm, positions);
        let bodies = self
            .arm
            .links()
            .zip(frames.iter().chain(std::iter::repeat(&self.arm.base)))
            .map(|(body, frame)| body.solids.iter().map(|hull| hull.placed(frame)).collect());
        let bodies = bodies.collect();
        let flange = flange(self.arm, &frames);
        Stance { bodies, tool: self.tool.iter().map(|hull| hull.placed(&flange)).collect() }
    }

    /// Returns the placed objects of a state.
    pub fn objects(&self, state: &State) -> Vec<(&'a str, PlacedHull)> {
        let placed = self.objects.iter().zip(&state.poses);
        placed
            .map(|((name, hull), pose)| (*name, hull.placed(&Pose3::upright(*pose, 0.0))))
            .collect()
    }

    /// Returns the names of the first colliding pair, if any: bodies of the arm, table, obstacles
    /// and `objects`. The tool counts only if it is `carried` at a distance from them, metres,
    /// because it touches objects when it pushes.
    pub fn met(
        &self,
        stance: &Stance,
        objects: &[(&str, PlacedHull)],
        carried: Option<f64>,
    ) -> Option<[String; 2]> {
        let links: Vec<&ArmBody> = self.arm.links().collect();
        let name = |k: usize| links[k].name.clone();
        for [a, b] in &self.arm.pairs {
            if touching(&stance.bodies[*a], &stance.bodies[*b], 0.0) == Some(true) {
                return Some([name(*a), name(*b)]);
            }
        }
        let count = self.arm.bodies.len();
        for (k, body) in stance.bodies.iter().enumerate() {
            // The last two bodies are next to the tool in all configurations.
            let beside = k >= count;
            if (beside || k + 2 < count) && touching(body, &stance.tool, 0.0) == Some(true) {
                return Some([name(k), TOOL.into()]);
            }
            if beside {
                continue;
            }
            if k >= self.above && body.iter().any(|hull| hull.lowest() < APART) {
                return Some([name(k), "table".into()]);
            }
            // The base does not move, so bodies next to it do not collide.
            if k > 0
                && let Some(other) = first_met(body, self.obstacles.iter().chain(objects))
            {
                return Some([name(k), other]);
            }
        }
        let apart = carried?;
        let mut others = self.obstacles.iter().chain(objects);
        let inside =
            |other: &PlacedHull| stance.tool.iter().any(|part| part.gap(other, apart) <= apart);
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

/// Returns whether bodies overlap; `None` if either has no solids.
fn touching(a: &[PlacedHull], b: &[PlacedHull], apart: f64) -> Option<bool> {
    let pairs = || a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
    pairs().next()?;
    Some(pairs().any(|(a, b)| a.gap(b, apart) <= apart))
}

/// Returns the parts of a tool in the frame of the flange.
fn of_tool(arm: &Arm, tool: &Tool) -> Vec<Hull> {
    let seen = arm.flange_of_tool().inverse();
    let grip = tool.grip.inverse();
    let parts = tool.parts().iter().map(|part| {
        let pose = seen * Pose3::upright(grip * part.pose, 0.0);
        Hull::prism(&part.footprint(), [0.0, part.shape.height()], &pose)
    });
    parts.collect()
}
