//! Suites of held-out pushes: scenes like the training scenes, but with the shipped tools, which
//! training never sees.

use std::sync::Arc;

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::seeded::generator;
use pushplan::internals::{
    scene::{Scene, Span},
    task::ToolMotion,
};
use pushplan_learn::dataset::{
    Aim, Constraints, Crowd, DatasetConfig, Episode, JointRule, Preset, Solids, aimed_stroke,
    anywhere, log_uniform, random_direction, random_heading, random_scene,
};
use serde::{Deserialize, Serialize};

/// Travel of every push, metres.
const TRAVEL: f64 = 0.20;

/// Speed of pushes with a fixed speed, m/s.
const SPEED: f64 = 0.10;

/// Range of random speeds, m/s.
const SPEEDS: Span = Span::new(0.03, 0.3);

/// Gap between tool and object at the start, metres, as planners place the tool.
const STAND_OFF: f64 = 0.005;

/// Height of the tools' underside above the table, metres.
const LIFT: f64 = 0.002;

/// The kinds of held-out pushes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SuiteKind {
    /// A single object, pushed 20 cm at 0.1 m/s.
    Single,
    /// A single object, pushed 20 cm at 0.03 to 0.3 m/s.
    SingleAnySpeed,
    /// Two or three objects that touch each other, pushed 20 cm at 0.1 m/s.
    Touching,
}

impl SuiteKind {
    /// Every kind.
    pub const ALL: [SuiteKind; 3] =
        [SuiteKind::Single, SuiteKind::SingleAnySpeed, SuiteKind::Touching];

    /// Returns a title for tables.
    pub fn title(self) -> &'static str {
        match self {
            SuiteKind::Single => "one object, 20 cm at 0.1 m/s",
            SuiteKind::SingleAnySpeed => "one object, 20 cm at 0.03 to 0.3 m/s",
            SuiteKind::Touching => "two or three touching objects, 20 cm at 0.1 m/s",
        }
    }
}

/// A push to predict.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Scene on the table.
    pub scene: Scene,
    /// A stroke of a shipped tool.
    pub motion: ToolMotion,
}

/// Pushes of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Suite {
    /// Kind of the pushes.
    pub kind: SuiteKind,
    /// The pushes; tools alternate, and so do cylinders and cuboids or two and three objects.
    pub cases: Vec<Case>,
}

impl Suite {
    /// Draws the first `count` cases of a kind under `seed`, with the tools of `library`, which
    /// must hold at least one.
    pub fn draw(kind: SuiteKind, library: &ToolLibrary, seed: u64, count: usize) -> Self {
        // Kinds must not share scenes.
        let seed = seed ^ ((kind as u64 + 1) << 32);
        let cases = if library.is_empty() { 0 } else { count };
        let cases = (0..cases).map(|index| draw_case(kind, library, seed, index)).collect();
        Self { kind, cases }
    }
}

/// Returns scenes of `objects` objects, scattered and dense in turn, with mixed joints, and the
/// first stroke of the hand in each. The network is timed on them. `objects` is from 2 to 12.
pub fn crowd_cases(objects: usize, seed: u64, count: usize) -> Vec<Case> {
    jointed_crowd_cases(objects, JointRule::Mixed, seed, count)
}

/// Returns [`crowd_cases`] with other joints.
pub(super) fn jointed_crowd_cases(
    objects: usize,
    joints: JointRule,
    seed: u64,
    count: usize,
) -> Vec<Case> {
    let config = |preset| DatasetConfig {
        seed,
        preset,
        constraints: Constraints::test(objects.clamp(2, 12), joints, Solids::Any),
        ..DatasetConfig::default()
    };
    let families = [Preset::Sparse, Preset::Dense].map(config);
    let case = |index: usize| {
        let Episode { scene, mut motion, .. } =
            Episode::of_crowd(&families[index % 2], index as u64);
        motion.strokes.truncate(1);
        Case { scene, motion }
    };
    (0..count).map(case).collect()
}

fn draw_case(kind: SuiteKind, library: &ToolLibrary, seed: u64, index: usize) -> Case {
    let mut rng = generator(seed, index as u64);
    let ranges = Preset::Tools.ranges();
    let tools: Vec<_> = library.iter().collect();
    let tool = tools[index % tools.len()];
    let even = (index / tools.len()).is_multiple_of(2);
    let crowd = match kind {
        SuiteKind::Single | SuiteKind::SingleAnySpeed => {
            let solids = if even { Solids::Cylinders } else { Solids::Cuboids };
            Crowd { count: 1, solids, touching: 0.0, polygons: 0.0 }
        }
        SuiteKind::Touching => Crowd {
            count: if even { 2 } else { 3 },
            solids: Solids::Any,
            touching: 1.0,
            polygons: 0.0,
        },
    };
    // Scenes in which the drawn push cannot start are drawn again; most can.
    loop {
        let scene = random_scene(&mut rng, &ranges, crowd);
        let scene = anywhere(&mut rng, scene);
        let state = scene.start();
        let direction = random_direction(&mut rng, &scene.objects, &state);
        let speed = match kind {
            SuiteKind::SingleAnySpeed => log_uniform(&mut rng, SPEEDS),
            SuiteKind::Single | SuiteKind::Touching => SPEED,
        };
        let heading = random_heading(&mut rng, direction);
        let aim = Aim { direction, heading, gap: STAND_OFF, travel: TRAVEL, speed };
        if let Some(stroke) = aimed_stroke(&mut rng, tool, &scene, &state, &aim) {
            let motion = ToolMotion { tool: Arc::clone(tool), lift: LIFT, strokes: vec![stroke] };
            return Case { scene, motion };
        }
    }
}
