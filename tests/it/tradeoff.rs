//! Speed against accuracy: coarser levels keep the interface of the finer ones.

use pushplan::store::{Seconds, Store, StoreError};
use pushplan::watch::Watch;
use pushplan::{
    asset::ToolLibrary,
    bench::{
        Level, PlanRow, Suite, SuiteKind, TradeOff, TradeOffReport, TradeOffSettings, Unit,
        dominates, levels, plan_levels,
    },
    effect::{EffectModel, EffectModels, Job, Network, Prior},
    report::{tradeoff_efforts, tradeoff_push_chart, tradeoff_task_chart},
    scene::Record,
    solve::{Effort, Settings},
};

fn network() -> Network {
    Network::new(EffectModels::weights().unwrap())
}

#[test]
fn longer_frames_give_the_same_instants_and_tool_poses_and_nearly_the_same_end() {
    let suite = Suite::draw(SuiteKind::Single, &ToolLibrary::embedded().unwrap(), 5, 8);
    let fine: Box<dyn EffectModel> = Box::new(network());
    for stride in [2, 3, 4, 64] {
        let coarse: [Box<dyn EffectModel>; 2] = [
            Box::new(network().with_stride(stride)),
            Box::new(Prior::default().with_stride(stride)),
        ];
        for (case, model) in suite.cases.iter().flat_map(|c| coarse.iter().map(move |m| (c, m))) {
            let job = Job::stated(&case.scene, case.motion.clone());
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
    assert_eq!(network().with_stride(2).name(), "brdpn-128, 20 mm frames");
    assert_eq!(network().with_steps(1).name(), "brdpn-128, 1 step");
    assert_eq!(Prior::default().with_stride(4).name(), "quasi-static, 40 mm frames");
}

/// A tiny run: two networks' levels, the prior and an engine.
fn tiny(library: &ToolLibrary) -> TradeOff<'_> {
    let weights = EffectModels::weights().unwrap();
    let mut levels = levels(&weights, &[("again".into(), weights.clone())]);
    let wanted = ["brdpn-128", "brdpn-128 (again)", "quasi-static", "planar", "still"];
    levels.retain(|level| wanted.contains(&level.name()));
    assert_eq!(levels.iter().map(Level::name).collect::<Vec<_>>(), wanted);
    let mut plans = plan_levels(&levels);
    plans.retain(|plan| plan.name.contains("coarse search, light refinement, up to 4 verified"));
    let counts =
        TradeOffSettings { pushes: 12, timed: 1, rounds: 2, tasks: 2, tolerance: 1.0, seed: 5 };
    TradeOff::new(library, levels, plans, counts).unwrap()
}

#[test]
fn every_level_is_measured_and_an_interrupted_run_goes_on() {
    struct Quiet;
    impl Watch for Quiet {}
    let library = ToolLibrary::embedded().unwrap();
    let run = tiny(&library);
    let folder = tempfile::TempDir::new().unwrap();
    let manifest = || run.manifest(&["one".into(), "two".into()]);
    let total = manifest().tasks;
    assert_eq!(total, 1 + 5 + 2 + 2);
    let mut store: Store<Unit> = Store::open(folder.path(), manifest(), &Quiet).unwrap();
    let stopped = store.run(&Quiet, |index| match index {
        7 => Err(StoreError::Missing { path: "stopped".into() }),
        index => Ok(run.measure(index).unwrap()),
    });
    assert!(stopped.is_err());
    drop(store);
    let mut store: Store<Unit> = Store::open(folder.path(), manifest(), &Quiet).unwrap();
    assert_eq!(store.finished().len(), 7);
    store.run::<StoreError>(&Quiet, |index| Ok(run.measure(index).unwrap())).unwrap();
    let units: Vec<(Unit, Seconds)> =
        store.finished().iter().map(|one| (one.record.clone(), one.seconds.clone())).collect();
    // All but times is the same when measured again.
    for index in [0, 1, 3, total - 1] {
        assert_eq!(run.measure(index).unwrap().record, units[index].0, "{}", run.title(index));
    }

    let report = run.report(&units);
    let named = |name: &str| report.predictors.iter().find(|row| row.model == name).unwrap();
    let mean = |name: &str| named(name).suites[0].position.as_ref().unwrap().mean;
    assert_eq!(mean("planar"), 0.0);
    assert_eq!(mean("brdpn-128"), mean("brdpn-128 (again)"));
    assert!(mean("brdpn-128") < mean("still"));
    for name in ["planar", "still"] {
        assert!(named(name).on_front, "{name} is the most accurate, or the cheapest");
    }
    assert!(report.objects.iter().all(|cost| cost.seconds > 0.0 && cost.planar_ratio > 0.0));
    assert_eq!(report.plans.len(), 4);
    assert!(report.plans.iter().all(|plan| plan.seconds > 0.0 && plan.rollouts > 100.0));
    assert!(report.plans.iter().any(|plan| plan.on_front));
    for choice in report.efforts.values() {
        let row = report.plans.iter().find(|row| row.level.name == choice.level).unwrap();
        assert!(row.on_front && row.level.settings == choice.settings);
    }
    let text = serde_json::to_string_pretty(&report).unwrap();
    assert_eq!(serde_json::from_str::<TradeOffReport>(&text).unwrap(), report);
    for chart in [tradeoff_push_chart(&report), tradeoff_task_chart(&report)] {
        assert!(!chart.to_svg().contains("NaN"));
    }
}

/// What `pushplan tradeoff` measured, as shipped.
const MEASURED: &str = include_str!("../../models/tradeoff.json");

#[test]
fn every_effort_is_a_measured_level_that_no_other_makes_needless() {
    let report: TradeOffReport = serde_json::from_str(MEASURED).unwrap();
    let row = |name: &str| report.plans.iter().find(|row| row.level.name == name).unwrap();
    let chosen: Vec<&PlanRow> = Effort::ALL
        .iter()
        .map(|effort| {
            let level = effort.level().expect("the library knows every effort");
            assert_eq!(Some(level), report.efforts.get(effort));
            let row = row(&level.level);
            assert_eq!((&row.level.model, row.level.settings), (&level.model, level.settings));
            let settings = effort.settings();
            assert_eq!(Settings { disturbed: 0, ..settings }, level.settings);
            assert_eq!(effort.model().unwrap().name(), level.model);
            row
        })
        .collect();
    for (effort, row) in Effort::ALL.iter().zip(&chosen) {
        assert!(row.on_front, "{effort} is not on the front");
        for other in &report.plans {
            assert!(
                !dominates(other.point(), row.point(), report.noise),
                "{effort}, {}, is dominated by {}",
                row.level.name,
                other.level.name
            );
        }
    }
    for pair in chosen.windows(2) {
        assert!(pair[0].seconds <= pair[1].seconds && pair[0].success <= pair[1].success);
    }
}

#[test]
fn the_readme_says_what_each_effort_costs_and_gives() {
    let report: TradeOffReport = serde_json::from_str(MEASURED).unwrap();
    let table = tradeoff_efforts(&report).to_markdown();
    assert!(include_str!("../../README.md").contains(&table), "the README has not\n{table}");
}
