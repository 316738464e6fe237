//! Speed against accuracy: coarser levels keep the interface of the finer ones.

use pushplan::{
    asset::ToolLibrary,
    bench::{Suite, SuiteKind},
    effect::{EffectModel, EffectModels, Job, Learned, QuasiStatic},
    scene::Record,
};

fn learned() -> Learned {
    Learned::new(EffectModels::weights().unwrap())
}

#[test]
fn longer_frames_give_the_same_instants_and_tool_poses_and_nearly_the_same_end() {
    let suite = Suite::draw(SuiteKind::Single, &ToolLibrary::embedded().unwrap(), 5, 8);
    let fine: Box<dyn EffectModel> = Box::new(learned());
    for stride in [2, 3, 4, 64] {
        let coarse: [Box<dyn EffectModel>; 2] = [
            Box::new(learned().with_stride(stride)),
            Box::new(QuasiStatic::default().with_stride(stride)),
        ];
        for (case, model) in suite.cases.iter().flat_map(|c| coarse.iter().map(move |m| (c, m))) {
            let job =
                Job { start: case.scene.start(), motion: case.motion.clone(), hypothesis: None };
            let jobs = [job];
            let [fine, coarse] = [&fine, model]
                .map(|model| model.rollout(&case.scene, &jobs, Record::Frames).remove(0));
            let moving = case.motion.strokes[0].frames();
            for (a, b) in fine.frames.iter().zip(&coarse.frames).take(moving + 1) {
                assert!((a.time - b.time).abs() < 1e-9, "{}", model.name());
                assert!((a.tool.position - b.tool.position).norm() < 1e-9, "{}", model.name());
            }
            let ends = [&fine, &coarse].map(|rolled| rolled.outcome().poses[0].position);
            let apart = (ends[0] - ends[1]).norm();
            assert!(stride > 4 || apart < 0.08, "{}: {apart} m apart", model.name());
            let alone = model.rollout(&case.scene, &jobs, Record::Outcome).remove(0);
            assert_eq!(alone.outcome(), coarse.outcome());
        }
    }
    assert_eq!(learned().with_stride(2).name(), "brdpn-128, 20 mm frames");
    assert_eq!(learned().with_steps(1).name(), "brdpn-128, 1 step");
    assert_eq!(QuasiStatic::default().with_stride(4).name(), "quasi-static, 40 mm frames");
}

#[test]
fn the_timed_rollout_is_the_rollout() {
    let suite = Suite::draw(SuiteKind::Touching, &ToolLibrary::embedded().unwrap(), 5, 2);
    let model = learned();
    for case in &suite.cases {
        let job = Job { start: case.scene.start(), motion: case.motion.clone(), hypothesis: None };
        let jobs = vec![job; 40];
        let (timed, network) = model.timed_rollout(&case.scene, &jobs);
        assert_eq!(timed, model.rollout(&case.scene, &jobs, Record::Outcome));
        assert!(network.as_nanos() > 0);
    }
}
