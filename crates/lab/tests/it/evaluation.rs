//! Held-out evaluation: drawn from the seed alone, judged correctly, independent of the number of
//! threads.

use std::sync::Arc;

use pushplan::{
    asset::ToolLibrary,
    effect::{EffectModel, Simulated, Still},
    sim::Simulator,
    solve::{Effort, Planner, Settings},
};
use pushplan_act::judge::MOVED;
use pushplan_lab::bench::{
    HeldOut, HeldOutReport, PlanErrors, RefinedTask, RefinementReport, Suite, SuiteKind,
    push_costs, random_task, refine_task, search_costs,
};
use pushplan_lab::trivial::Projection;

fn library() -> ToolLibrary {
    ToolLibrary::embedded().unwrap()
}

fn report(kind: SuiteKind, models: &[&dyn EffectModel]) -> HeldOutReport {
    HeldOut::prepare(kind, &library(), 5, 24).report(models)
}

#[test]
fn suites_use_every_shipped_tool_in_turn_and_both_shapes() {
    let library = library();
    let suite = Suite::draw(SuiteKind::Single, &library, 5, 2 * library.len());
    for (index, case) in suite.cases.iter().enumerate() {
        let tool = library.iter().nth(index % library.len()).unwrap();
        assert_eq!(case.motion.tool.name, tool.name);
        assert_eq!(case.scene.objects.len(), 1);
        assert_eq!(case.scene.objects[0].shape.is_cylinder(), index < library.len());
        assert!((case.motion.strokes[0].travel() - 0.20).abs() < 1e-9);
        assert!((case.motion.strokes[0].duration - 2.0).abs() < 1e-9);
    }
    let longer = Suite::draw(SuiteKind::Single, &library, 5, 3 * library.len());
    assert_eq!(longer.cases[..suite.cases.len()], suite.cases);
    let touching = Suite::draw(SuiteKind::Touching, &library, 5, 2 * library.len());
    assert!(touching.cases.iter().any(|case| case.scene.objects.len() == 3));
}

#[test]
fn a_model_that_is_the_truth_has_no_error_and_one_that_stays_errs_by_the_motion() {
    let (truth, still) = (Simulated::new(Simulator::planar()), Still);
    for kind in SuiteKind::ALL {
        let report = report(kind, &[&truth, &still]);
        let motion = report.motion.clone().expect("something moves");
        assert!(motion.mean > MOVED);
        let [spread, planar, stays] = &report.models[..] else { panic!("three entries") };
        assert_eq!(planar.rows[0].position.as_ref().map(|s| s.max), Some(0.0), "{kind:?}");
        assert_eq!(planar.rows[0].failed, 0);
        assert_eq!(stays.rows[0].position.as_ref(), Some(&motion), "{kind:?}");
        assert!(spread.rows[0].position.as_ref().is_some_and(|s| s.median < 1e-3));
        let all = planar.rows[0].position.as_ref().map_or(0, |s| s.count);
        let parts = |name: &str| {
            let row = planar.rows.iter().find(|row| row.group == name);
            row.and_then(|row| row.position.as_ref()).map_or(0, |s| s.count)
        };
        assert_eq!(parts("cylinders") + parts("cuboids"), all);
        assert_eq!(parts("1 object") + parts("2 objects") + parts("3 objects"), all);
    }
}

#[test]
fn one_and_two_threads_give_the_same_report_and_it_survives_json() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| report(SuiteKind::Touching, &[&Projection]))
    };
    let one = with(1);
    assert_eq!(one, with(2));
    let text = serde_json::to_string(&one).unwrap();
    let back: HeldOutReport = serde_json::from_str(&text).unwrap();
    assert_eq!(back.models[1].rows.len(), one.models[1].rows.len());
}

#[test]
fn random_tasks_are_solvable_and_refinement_never_makes_a_prediction_worse() {
    let settings = Settings { replays: 0, ..Effort::Draft.settings() };
    // The tool retreats before it is lifted, as in verification.
    let truth = || Simulated::new(Simulator::planar().retreating());
    let planner = |settings| Planner::builder(truth()).settings(settings).build();
    let without = planner(Settings { refine_rounds: 0, ..settings });
    let with = planner(settings);
    let measured = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let one = |index| refine_task([&without, &with], &library(), 1, index).unwrap().record;
        let done: Vec<RefinedTask> = pool.install(|| (0..6).map(one).collect());
        RefinementReport::of("planar", 1, &done.iter().collect::<Vec<_>>())
    };
    let report = measured(2);
    assert_eq!((report.tasks, report.worse, report.programmes_failed), (6, 0, 0));
    assert!(report.programmes > 0 && report.after.solved >= report.before.solved, "{report:?}");
    // The model is the ground truth, so its predictions are exact.
    for errors in [&report.before, &report.after] {
        assert_eq!(errors.predicted, errors.planar);
    }
    let mean = |errors: &PlanErrors| errors.planar.as_ref().map_or(f64::NAN, |s| s.mean);
    assert!(mean(&report.after) < 0.5 * mean(&report.before), "{report:?}");
    assert_eq!(report, measured(1));
}

#[test]
fn costs_are_measured_for_every_model_and_engine() {
    let library = library();
    let suite = Suite::draw(SuiteKind::Single, &library, 5, 2);
    let costs = push_costs(&Projection, &suite, 4).unwrap();
    let names: Vec<&str> = costs.iter().map(|cost| cost.model.as_str()).collect();
    assert_eq!(names, ["projection", "projection", "planar", "3d"]);
    let task = random_task(&library, 1, 0);
    let models: [Arc<dyn EffectModel>; 1] = [Arc::new(Projection)];
    let searched = search_costs(&models, &task, &library, 3, 100).unwrap();
    assert!(searched[0].rollouts > 0 && searched[0].rollouts <= 100);
    assert!(searched[0].seconds > 0.0);
}
