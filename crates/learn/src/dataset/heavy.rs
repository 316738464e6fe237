//! Cylinders of three mass ranges pushed by the hand, as data for estimating masses (Tekden 2020,
//! section 8.3).

use pushplan::internals::seeded::generator;
use pushplan::internals::sim::Simulator;
use pushplan::internals::{
    outcome::{Frame, Record},
    scene::{Body, Ranges, Scene, Span},
    task::{Job, ToolMotion},
};
use rand::Rng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::constraints::TEST_SPEED;
use super::controlled;
use super::controlled::Controlled;
use super::curriculum::Block;
use super::dense::grid;
use super::distributions::log_uniform;
use super::hand::HandPlay;
use super::preset::Preset;
use super::sparse::aimed;
use super::tabletop::{Crowd, Solids, anywhere, random_scene};

/// Mass ranges, kg.
pub const MASS_RANGES: [Span; 3] = [Span::new(0.2, 0.5), Span::new(1.0, 2.0), Span::new(8.0, 10.0)];

/// Number of strokes into a crowd.
const STROKES: usize = 3;

/// Length of a stroke, metres.
const TRAVEL: f64 = 0.5;

/// Cylinders without joints.
const CYLINDERS: Block = Block { cylinders: 1.0, joined: 0.0, kinds: [1.0; 3] };

/// Arrangement of objects on the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MassSetup {
    /// Given number of touching objects, and one stroke.
    Touching(usize),
    /// Given number of objects in a nearly touching grid, and three strokes.
    Crowd(usize),
    /// Fixed arrangement in which only masses vary.
    Controlled(Controlled),
}

/// Scene with masses from [`MASS_RANGES`], the hand's motion and its effect.
#[derive(Clone, Debug, PartialEq)]
pub struct MassEpisode {
    /// Scene at the start.
    pub scene: Scene,
    /// Motion of the hand.
    pub motion: ToolMotion,
    /// Frames of the 2-D engine, starting with the initial one.
    pub frames: Vec<Frame>,
    /// Index of the mass range of every object.
    pub ranges: Vec<usize>,
    /// Contacts of every object.
    pub touched: Vec<Touched>,
}

/// Kind of contact that an object had.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Touched {
    /// No contact.
    Nothing,
    /// Contact with the hand only.
    Hand,
    /// Contact with another object.
    Object,
}

impl MassEpisode {
    /// Draws and simulates episode `index` under `seed`.
    pub fn draw(setup: MassSetup, seed: u64, index: u64) -> Self {
        let mut rng = generator(seed, index);
        let ranges = Ranges { speed: Span::new(TEST_SPEED, TEST_SPEED), ..Preset::Dense.ranges() };
        loop {
            if let Some(drawn) = attempt(&mut rng, &ranges, setup) {
                return drawn;
            }
        }
    }
}

/// Draws and simulates an episode; `None` if no stroke could be aimed or an object did not come to
/// rest.
fn attempt(rng: &mut Pcg64, ranges: &Ranges, setup: MassSetup) -> Option<MassEpisode> {
    let (mut scene, strokes) = match setup {
        MassSetup::Touching(count) => {
            let crowd = Crowd { count, solids: Solids::Cylinders, touching: 1.0, polygons: 0.0 };
            let scene = random_scene(rng, ranges, crowd);
            (anywhere(rng, scene), 1)
        }
        MassSetup::Crowd(count) => {
            let objects = Span::new(count as f64, count as f64);
            let scene = grid(rng, &Ranges { objects, ..*ranges }, &CYLINDERS);
            (anywhere(rng, scene), STROKES)
        }
        MassSetup::Controlled(controlled) => (controlled.scene(), 0),
    };
    let of = |_| rng.random_range(0..MASS_RANGES.len());
    let in_ranges: Vec<usize> = scene.objects.iter().map(of).collect();
    for (object, range) in scene.objects.iter_mut().zip(&in_ranges) {
        object.mass = log_uniform(rng, MASS_RANGES[*range]);
    }
    let ranges = match setup {
        MassSetup::Controlled(_) => &Ranges { friction: controlled::FRICTION, ..*ranges },
        _ => ranges,
    };
    let mut play = HandPlay::new(rng, &scene, ranges);
    for _ in 0..strokes {
        let stroke = aimed(rng, &scene, &play, TRAVEL, ranges.speed.high)?;
        play = play.play(stroke)?;
    }
    if let MassSetup::Controlled(controlled) = setup {
        for ([from, travel], speed) in controlled.strokes() {
            let stroke = play.stroke(&play.state(), from, travel, speed)?;
            play = play.play(stroke)?;
        }
    }
    let (motion, frames) = play.finish();
    let touched = touched(&scene, &motion);
    Some(MassEpisode { scene, motion, frames, ranges: in_ranges, touched })
}

fn touched(scene: &Scene, motion: &ToolMotion) -> Vec<Touched> {
    let job = Job::stated(scene, motion.clone());
    let contacts = Simulator::planar().run(scene, &job, Record::Frames).contacts;
    let mut touched = vec![Touched::Nothing; scene.objects.len()];
    for contact in contacts {
        match contact.with {
            Body::Object(other) => {
                touched[contact.object] = Touched::Object;
                touched[other] = Touched::Object;
            }
            Body::Part(_) if touched[contact.object] == Touched::Nothing => {
                touched[contact.object] = Touched::Hand;
            }
            _ => {}
        }
    }
    touched
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_controlled_set_ups_only_masses_differ_and_every_object_is_touched_by_another() {
        for controlled in [Controlled::Rows, Controlled::Wedges] {
            let drawn =
                [0, 1, 2].map(|k| MassEpisode::draw(MassSetup::Controlled(controlled), 3, k));
            let [first, others @ ..] = &drawn;
            for other in others {
                assert_eq!(first.motion.strokes, other.motion.strokes);
                let masses = other.scene.objects.iter().map(|object| object.mass);
                let mut scene = first.scene.clone();
                scene.objects.iter_mut().zip(masses).for_each(|(object, mass)| object.mass = mass);
                assert_ne!(scene, first.scene);
                assert_eq!(scene, other.scene);
            }
            let touched = drawn.iter().flat_map(|episode| &episode.touched);
            let all = touched.clone().count();
            let by_another = touched.filter(|touched| **touched == Touched::Object).count();
            assert_eq!((by_another, all), (27, 27), "{controlled:?}");
        }
    }

    #[test]
    fn masses_are_in_their_ranges_and_what_is_touched_moves() {
        for setup in [MassSetup::Touching(3), MassSetup::Crowd(6)] {
            let episode = MassEpisode::draw(setup, 3, 1);
            assert_eq!(episode, MassEpisode::draw(setup, 3, 1));
            for (object, range) in episode.scene.objects.iter().zip(&episode.ranges) {
                let Span { low, high } = MASS_RANGES[*range];
                assert!((low..=high).contains(&object.mass), "{}", object.mass);
            }
            let end = &episode.frames.last().expect("it moves").state;
            for (k, object) in episode.scene.objects.iter().enumerate() {
                let gone = end.poses[k].position - object.pose.position;
                let still = episode.touched[k] == Touched::Nothing;
                assert!(!still || gone.norm() < 1e-6, "{setup:?}: {k} moved by {gone}");
            }
            assert!(episode.touched.iter().any(|touched| *touched != Touched::Nothing));
        }
    }
}
