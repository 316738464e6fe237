//! The whole network: its symmetries and its weights file.

use std::sync::Arc;

use pushplan::{
    effect::{EffectModel, Network},
    geometry::{Pose, Shape, Vector},
    graph::Corrections,
    network::{
        Buffers, Card, ErrorCard, Forward, LeverCard, PredictorCard, PredictorWeights, Weights,
        WeightsError,
    },
    outcome::Record,
    scene::{Part, Scene, State, Tool, Velocity},
    task::{Job, Stroke, ToolMotion},
};
use pushplan_act::regulator::{RegulatorCard, RegulatorWeights};

use crate::random_network::{batch, half_stroke, scene, stroke, tool, weights};

fn rollout(model: &Network, scene: &Scene, stroke: Stroke) -> State {
    let motion = ToolMotion { tool: tool(), lift: 0.002, strokes: vec![stroke] };
    let job = Job::stated(scene, motion);
    model.rollout(scene, &[job], Record::Outcome)[0].outcome().clone()
}

/// Tolerance: one hundredth of a millimetre over ten frames is 1e-4 of the motion per frame.
const SAME: f64 = 1e-5;

pub(super) fn assert_same(a: &State, b: &State) {
    for (p, q) in a.poses.iter().zip(&b.poses) {
        assert!((p.position - q.position).norm() < SAME, "{p:?} {q:?}");
    }
}

fn moved(scene: &Scene, by: Pose) -> Scene {
    let mut scene = scene.clone();
    scene.objects.iter_mut().for_each(|o| o.pose = by * o.pose);
    scene.obstacles.iter_mut().for_each(|o| o.pose = by * o.pose);
    scene
}

#[test]
fn turning_and_shifting_the_scene_turns_and_shifts_the_prediction() {
    let model = Network::new(weights(64));
    let (scene, stroke) = (scene(), half_stroke());
    let plain = rollout(&model, &scene, stroke);
    for by in [Pose::new(0.7, -1.3, 2.2), Pose::new(-4.0, 2.0, -0.4)] {
        let turned = Stroke { from: by * stroke.from, to: by * stroke.to, ..stroke };
        let there = rollout(&model, &moved(&scene, by), turned);
        let back = State::at_rest(there.poses.iter().map(|p| by.inverse() * *p).collect());
        assert_same(&plain, &back);
    }
}

#[test]
fn mirroring_the_scene_mirrors_the_prediction() {
    let model = Network::new(weights(64));
    let mirror = |p: Pose| Pose::new(p.position.x, -p.position.y, -p.heading);
    let (scene, stroke) = (scene(), half_stroke());
    let plain = rollout(&model, &scene, stroke);
    let mut other = scene.clone();
    other.objects.iter_mut().for_each(|o| o.pose = mirror(o.pose));
    other.obstacles.iter_mut().for_each(|o| o.pose = mirror(o.pose));
    let tool = tool();
    let parts = tool.parts().iter().map(|p| Part { pose: mirror(p.pose), ..p.clone() });
    let mirrored = Tool::clone(&tool).with_parts(parts).expect("one piece");
    let stroke = Stroke { from: mirror(stroke.from), to: mirror(stroke.to), ..stroke };
    let motion = ToolMotion { tool: Arc::new(mirrored), lift: 0.002, strokes: vec![stroke] };
    let job = Job::stated(&other, motion);
    let there = model.rollout(&other, &[job], Record::Outcome)[0].outcome().clone();
    let back = State::at_rest(there.poses.iter().map(|p| mirror(*p)).collect());
    assert_same(&plain, &back);
}

#[test]
fn the_order_of_objects_and_parts_does_not_matter() {
    let model = Network::new(weights(64));
    let scene = scene();
    let mut other = scene.clone();
    other.objects.reverse();
    let tool = tool();
    let parts = tool.parts().iter().rev().cloned();
    let reversed = Arc::new(Tool::clone(&tool).with_parts(parts).expect("one piece"));
    // Before the squeeze, in which a random network amplifies the order of a sum to millimetres.
    // The analytic model alone, which sums in double precision, is tested far more strictly in
    // `symmetry`.
    let stroke = Stroke { to: Pose::new(0.04, 0.008, 0.0), duration: 0.4, ..half_stroke() };
    let plain = rollout(&model, &scene, stroke);
    let motion = ToolMotion { tool: reversed, lift: 0.002, strokes: vec![stroke] };
    let job = Job::stated(&other, motion);
    let mut there = model.rollout(&other, &[job], Record::Outcome)[0].outcome().clone();
    there.poses.reverse();
    assert_same(&plain, &there);
}

#[test]
fn another_description_of_the_same_cuboid_changes_nothing() {
    use std::f64::consts::{FRAC_PI_2, PI};
    let model = Network::new(weights(64));
    let (scene, stroke) = (scene(), half_stroke());
    let plain = rollout(&model, &scene, stroke);
    let mut half_turned = scene.clone();
    half_turned.objects[0].pose.heading += PI;
    assert_same(&plain, &rollout(&model, &half_turned, stroke));
    let mut square_turned = scene.clone();
    square_turned.objects[2].pose.heading -= FRAC_PI_2;
    assert_same(&plain, &rollout(&model, &square_turned, stroke));
    let mut swapped = scene.clone();
    swapped.objects[0].shape = Shape::Cuboid { size: [0.05, 0.08, 0.1] };
    swapped.objects[0].pose.heading += FRAC_PI_2;
    assert_same(&plain, &rollout(&model, &swapped, stroke));
    let mut turned_cylinder = scene.clone();
    turned_cylinder.objects[1].pose.heading += 1.0;
    assert_same(&plain, &rollout(&model, &turned_cylinder, stroke));
}

#[test]
fn a_golden_forward_pass() {
    let weights = weights(32);
    let mut state = scene().start();
    state.velocities[1] = Velocity { linear: Vector::new(0.05, 0.02), angular: 0.4 };
    let mut corrections = Corrections::default();
    let batch = batch(&scene(), &state, &stroke());
    Forward::new(&weights).run(&batch, &mut Buffers::default(), &mut corrections);
    assert_eq!(corrections.nodes.len(), GOLDEN.len());
    let found = corrections.nodes.iter().flat_map(|correction| correction.readouts.concat());
    for (found, golden) in found.zip(GOLDEN.iter().flatten()) {
        assert!((found - golden).abs() < 1e-4, "{corrections:?}");
    }
}

/// Values printed by this test when the network was last found equal to its candle graph.
const GOLDEN: [[f64; 6]; 3] = [
    [-0.09518, -0.00548, -0.00423, 0.07760, 0.00225, -0.00954],
    [-0.18089, -0.02108, -0.03864, 0.14065, -0.00392, 0.02868],
    [-0.09732, 0.01748, 0.00944, 0.05653, 0.00075, -0.00893],
];

#[test]
fn weights_survive_their_file_and_damage_is_refused() {
    let weights = weights(32);
    let bytes = weights.to_bytes().expect("encode");
    assert_eq!(bytes, weights.to_bytes().expect("encode"), "same weights, same bytes");
    assert_eq!(PredictorWeights::from_bytes(&bytes).expect("decode"), weights);
    assert!(matches!(PredictorWeights::from_bytes(&bytes[..50]), Err(WeightsError::Format(_))));
    assert!(PredictorWeights::from_bytes(b"name: stick").is_err());
}

#[test]
fn a_single_wrong_bit_of_a_tensor_or_of_the_card_is_found() {
    let bytes = weights(32).to_bytes().expect("encode");
    let header = u64::from_le_bytes(bytes[..8].try_into().expect("eight bytes")) as usize;
    let tensors = 8 + header;
    for at in (tensors..bytes.len()).step_by(997) {
        let mut flipped = bytes.clone();
        // The lowest bit of a mantissa, so that the value is still a valid number.
        flipped[tensors + (at - tensors) / 4 * 4] ^= 1;
        let error = PredictorWeights::from_bytes(&flipped).expect_err("damage");
        assert!(matches!(error, WeightsError::Checksum { .. }), "{error}");
    }
    // In the header, a quotation mark of the card follows a backslash.
    let key = br#"episodes\":"#;
    let episodes = bytes.windows(key.len()).position(|window| window == key);
    let mut other = bytes.clone();
    let digit = &mut other[episodes.expect("a key of the card") + key.len()];
    assert_eq!(*digit, b'0', "the number of episodes");
    *digit = b'1';
    let error = PredictorWeights::from_bytes(&other).expect_err("damage");
    assert!(matches!(error, WeightsError::Checksum { .. }), "{error}");
}

#[test]
fn weights_that_no_training_gives_are_refused_by_name() {
    type Spoil = fn(&mut PredictorWeights);
    let spoilt: [(Spoil, &str); 7] = [
        (|w| set(w, "update.own", f32::NAN), "the parameter `update.own` holds a number"),
        (|w| set(w, "update.own", 1e9), "`update.own` is 1000000000, up to 1000 is sound"),
        (|w| w.card.normaliser.node_even.mean[0] = 1e9, "normaliser.node_even.mean is"),
        (|w| w.card.normaliser.node_odd.deviation[1] = 0.0, "normaliser.node_odd.deviation is 0"),
        (|w| w.card.normaliser.node_odd.deviation.truncate(1), "has a wrong length"),
        (|w| w.card.ranges.mass.low = 9.0, "ranges.mass is 9"),
        (|w| w.card.errors = Some(ERRORS), "errors.p95 is -1, 0 to 100 m is sound"),
    ];
    for (spoil, expected) in spoilt {
        let mut weights = weights(32);
        spoil(&mut weights);
        let bytes = weights.to_bytes().expect("encode");
        let error = PredictorWeights::from_bytes(&bytes).expect_err(expected).to_string();
        assert!(error.contains(expected), "{error}");
    }
}

const ERRORS: ErrorCard = ErrorCard { pushes: 10, mean: 1e-3, median: 1e-4, p95: -1.0 };

fn set(weights: &mut PredictorWeights, name: &str, value: f32) {
    weights.parameters.values.get_mut(name).expect("a parameter")[3] = value;
}

#[test]
fn the_shipped_weights_are_written_as_they_were_read() {
    fn same<C: Card>(shipped: &[u8]) {
        let weights = Weights::<C>::from_bytes(shipped).expect("shipped weights");
        let written = weights.to_bytes().expect("encode");
        assert!(written == shipped, "reading and writing changes the file of {}", C::KEY);
    }
    same::<PredictorCard>(include_bytes!("../../crates/models/brdpn.safetensors"));
    same::<RegulatorCard>(include_bytes!("../../crates/models/regulator.safetensors"));
    same::<LeverCard>(include_bytes!("../../crates/models/lever.safetensors"));
}

#[test]
fn a_file_of_one_network_is_none_of_another() {
    let lever = include_bytes!("../../crates/models/lever.safetensors");
    let error = PredictorWeights::from_bytes(lever).expect_err("another network").to_string();
    assert!(error.contains("no `pushplan` entry"), "{error}");
    let error = RegulatorWeights::from_bytes(lever).expect_err("another network").to_string();
    assert!(error.contains("no `pushplan-regulator` entry"), "{error}");
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let model = Network::new(weights(64));
    let scene = scene();
    let jobs: Vec<Job> = (0..70)
        .map(|k| {
            let to = Pose::new(0.1, 0.001 * f64::from(k), 0.0);
            let strokes = vec![Stroke { to, ..stroke() }];
            let motion = ToolMotion { tool: tool(), lift: 0.002, strokes };
            Job::stated(&scene, motion)
        })
        .collect();
    let run = |threads| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("pool")
            .install(|| model.rollout(&scene, &jobs, Record::Frames))
    };
    let one = run(1);
    for threads in [2, 3] {
        assert!(one == run(threads), "{threads} threads differ from one");
    }
}
