//! Equality of the propagation network in candle and in planning.

use pushplan::contact::{Bodies, FrameProblem};
use pushplan::graph::{Batch, OUTPUT_EVEN, OUTPUT_ODD};
use pushplan::network::{Buffers, Forward};
use pushplan::progress::NoProgress;
use pushplan::scene::Physics;
use pushplan_learn::dataset::{Dataset, DatasetConfig};
use pushplan_learn::network::{Inputs, Predictor};

use crate::random_network::{add_graph, weights};

#[test]
fn fused_inference_equals_the_candle_graph() {
    let data = DatasetConfig { seed: 11, episodes: 20, ..DatasetConfig::default() };
    let data = Dataset::in_memory(&data, &NoProgress).expect("data");
    let mut batch = Batch::default();
    for (k, episode) in data.episodes().iter().enumerate() {
        let bodies = Bodies::new(
            &episode.scene,
            &episode.motion.tool,
            0.002,
            &Physics::stated(&episode.scene),
        );
        let stroke = &episode.motion.strokes[0];
        let axis = (stroke.to.position - stroke.from.position).normalize();
        for index in 0..stroke.frames().min(episode.frames.len()) {
            let (state, step) = (&episode.frames[index].state, stroke.frame(index));
            let problem = FrameProblem { bodies: &bodies, state, step: &step, axis };
            add_graph(&mut batch, k as u32, problem);
        }
    }
    assert!(batch.node_count() > 100);
    for width in [32, 128] {
        let weights = weights(width);
        let reference = Predictor::new(weights.card.config, &weights.parameters)
            .and_then(|net| net.forward(&Inputs::new(&batch, &weights.card.normaliser)?))
            .and_then(|out| out.to_vec2::<f32>())
            .expect("candle");
        let mut buffers = Buffers::default();
        let forward = Forward::new(&weights);
        let (even, odd) = forward.read(&batch, &mut buffers);
        let rows = even.chunks_exact(OUTPUT_EVEN).zip(odd.chunks_exact(OUTPUT_ODD));
        let fused: Vec<Vec<f32>> = rows.map(|(even, odd)| [even, odd].concat()).collect();
        assert_eq!(reference.len(), fused.len());
        let scale = reference.iter().flatten().fold(0.0f32, |m, x| m.max(x.abs()));
        for (a, b) in reference.iter().flatten().zip(fused.iter().flatten()) {
            assert!((a - b).abs() < 2e-5 * scale, "{a} {b}");
        }
    }
}
