//! Speed against accuracy: coarser levels keep the interface of the finer ones.

use pushplan::progress::Progress;
use pushplan::{
    asset::ToolLibrary,
    effect::{EffectModel, EffectModels, Fallback, Job},
    outcome::Record,
    scene::ModelSpec,
    solve::{Effort, Settings},
};
use pushplan_bench::store::{Seconds, Store, StoreError};
use pushplan_lab::bench::{
    Level, ObjectCost, PlanRow, Suite, SuiteKind, TradeOff, TradeOffReport, TradeOffSettings, Unit,
    dominates, is_open, levels, plan_levels,
};
use pushplan_lab::published::{place, select, tables};
use pushplan_lab::report::tradeoff_document;

fn model(spec: &str) -> Fallback {
    EffectModels::build(&spec.parse().unwrap()).unwrap()
}

#[test]
fn longer_frames_give_the_same_instants_and_tool_poses_and_nearly_the_same_end() {
    let suite = Suite::draw(SuiteKind::Single, &ToolLibrary::embedded().unwrap(), 5, 8);
    let fine = model("network");
    for stride in [2, 3, 4, 64] {
        let coarse = [
            model(&format!("network,frame={}mm", 10 * stride)),
            model(&format!("prior,frame={}mm", 10 * stride)),
        ];
        for (case, model) in suite.cases.iter().flat_map(|c| coarse.iter().map(move |m| (c, m))) {
            let job = Job::stated(&case.scene, case.motion.clone());
            let jobs = [job];
            let [fine, coarse] = [&fine, model]
                .map(|model| model.rollout(&case.scene, &jobs, Record::Frames).remove(0));
            let moving = case.motion.strokes[0].frames();
            // A run with a jam is recorded up to the jam; its last frame is the end.
            let shown = fine.frames.len().min(coarse.frames.len()) - 1;
            for (a, b) in fine.frames.iter().zip(&coarse.frames).take(shown.min(moving + 1)) {
                assert!((a.time - b.time).abs() < 1e-9, "{}", model.spec());
                assert!((a.tool.position - b.tool.position).norm() < 1e-9, "{}", model.spec());
            }
            let ends = [&fine, &coarse].map(|rolled| rolled.outcome().poses[0].position);
            let apart = (ends[0] - ends[1]).norm();
            assert!(stride > 4 || apart < 0.08, "{}: {apart} m apart", model.spec());
            let alone = model.rollout(&case.scene, &jobs, Record::Outcome).remove(0);
            assert_eq!(alone.outcome(), coarse.outcome());
        }
    }
}

/// Returns a tiny run: levels of two networks, the analytic model and an engine.
fn tiny<'a>(library: &'a ToolLibrary, again: &str) -> TradeOff<'a> {
    let mut levels = levels(&[again.to_owned()]).unwrap();
    let again = format!("network,weights={again}");
    let wanted = ["network", &again, "prior", "planar", "still"];
    levels.retain(|level| wanted.contains(&level.name()));
    assert_eq!(levels.iter().map(Level::name).collect::<Vec<_>>(), wanted);
    let mut plans = plan_levels(&levels);
    plans.retain(|plan| {
        plan.name.contains("light refinement, up to 4 verified, 2 at a time, 4 disturbed")
    });
    let counts =
        TradeOffSettings { pushes: 12, timed: 1, rounds: 2, tasks: 2, tolerance: 1.0, seed: 5 };
    TradeOff::new(library, levels, plans, counts).unwrap()
}

#[test]
fn every_level_is_measured_and_an_interrupted_run_goes_on() {
    struct Quiet;
    impl Progress for Quiet {}
    let library = ToolLibrary::embedded().unwrap();
    let folder = tempfile::TempDir::new().unwrap();
    let file = folder.path().join("again.safetensors").display().to_string();
    std::fs::write(&file, EffectModels::weights().unwrap().to_bytes().unwrap()).unwrap();
    let again = format!("network,weights={file}");
    let run = tiny(&library, &file);
    let manifest = || run.manifest(&["one".into(), "two".into()]);
    let total = manifest().tasks;
    assert_eq!(total, 1 + 5 + 2 + 2);
    let mut store: Store<Unit> =
        Store::open(&folder.path().join("run"), manifest(), &Quiet).unwrap();
    let stopped = store.run(&Quiet, |index| match index {
        7 => Err(StoreError::Missing { path: "stopped".into() }),
        index => Ok(run.measure(index).unwrap()),
    });
    assert!(stopped.is_err());
    drop(store);
    let mut store: Store<Unit> =
        Store::open(&folder.path().join("run"), manifest(), &Quiet).unwrap();
    assert_eq!(store.finished().len(), 7);
    store.run::<StoreError>(&Quiet, |index| Ok(run.measure(index).unwrap())).unwrap();
    let units: Vec<(Unit, Seconds)> =
        store.finished().iter().map(|one| (one.record.clone(), one.seconds.clone())).collect();
    // Everything except times is equal when measured again.
    for index in [0, 1, 3, total - 1] {
        assert_eq!(run.measure(index).unwrap().record, units[index].0, "{}", run.title(index));
    }

    let report = run.report(&units);
    let named = |name: &str| report.predictors.iter().find(|row| row.model == name).unwrap();
    let mean = |name: &str| named(name).suites[0].position.as_ref().unwrap().mean;
    assert_eq!(mean("planar"), 0.0);
    assert_eq!(mean("network"), mean(&again));
    assert!(mean("network") < mean("still"));
    for name in ["planar", "still"] {
        assert!(named(name).on_front, "{name} is the most accurate, or the cheapest");
    }
    assert!(report.objects.iter().all(|cost| cost.seconds > 0.0 && cost.planar_ratio > 0.0));
    assert_eq!(report.plans.len(), 4);
    assert!(report.plans.iter().all(|plan| plan.seconds > 0.0 && plan.rollouts > 100.0));
    assert!(report.plans.iter().any(|plan| plan.on_front));
    for choice in report.efforts.values() {
        let row = report.plans.iter().find(|row| row.level.name == choice.name).unwrap();
        assert!(is_open(&row.level) && row.level == *choice);
    }
    let text = serde_json::to_string_pretty(&report).unwrap();
    assert_eq!(serde_json::from_str::<TradeOffReport>(&text).unwrap(), report);
    let document = tradeoff_document(&report);
    assert_eq!(document.figures().count(), 2);
    assert!(document.figures().all(|chart| !chart.to_svg().contains("NaN")));
    assert!(document.to_page().contains("](tradeoff-push.svg)"));
}

/// Published results of `pushplan-lab tradeoff`, and their page.
const MEASURED: &str = include_str!("../../results/tradeoff.json");
const PAGE: &str = include_str!("../../results/tradeoff.md");

/// Returns `true` if an effort runs the model and budgets that were published for it, as far as
/// pushes go. Levels of earlier versions that name two models are others.
fn is_published(effort: Effort, report: &TradeOffReport) -> bool {
    let level = &report.efforts[&effort];
    let model = ModelSpec::of(effort.model().first().kind.clone());
    let Settings { replays, levers, .. } = level.settings;
    let pushing = Settings { replays, levers, ..effort.settings() };
    let named = level.name.starts_with(&format!("{model}:"));
    named && model == level.model && pushing == level.settings
}

#[test]
fn every_effort_is_a_measured_level_that_no_other_makes_needless() {
    let report: TradeOffReport = serde_json::from_str(MEASURED).unwrap();
    // Published levels that no effort runs are evidence of nothing, and their page must state that.
    if !Effort::ALL.iter().all(|effort| is_published(*effort, &report)) {
        let stale = place(PAGE, "tradeoff").expect("a place").stale;
        assert!(stale.is_some(), "efforts run other models: `pushplan-lab measure tradeoff`");
        return;
    }
    let row = |name: &str| report.plans.iter().find(|row| row.level.name == name).unwrap();
    let chosen: Vec<&PlanRow> = Effort::ALL
        .iter()
        .map(|effort| {
            let level = &report.efforts[effort];
            let row = row(&level.name);
            assert_eq!(&row.level, level);
            assert!(effort.settings().replays >= level.settings.replays, "{effort}");
            row
        })
        .collect();
    for (effort, row) in Effort::ALL.iter().zip(&chosen) {
        assert!(row.is_complete() && is_open(&row.level), "{effort}");
        let others = report.plans.iter().filter(|other| other.is_complete());
        for other in others.filter(|other| is_open(&other.level)) {
            assert!(
                !dominates(other.point(), row.point(), report.noise),
                "{effort}, {}, is dominated by {}",
                row.level.name,
                other.level.name
            );
        }
    }
    // An effort fails at most this much more often than the best level with the network.
    let open = report.plans.iter().filter(|row| row.is_complete() && is_open(&row.level));
    let best = open.map(|row| row.robustness).fold(0.0, f64::max);
    for (row, loss) in chosen.iter().zip([0.10, 0.032, 0.01]) {
        assert!(row.robustness >= best - loss - 1e-9, "{}", row.level.name);
    }
    for pair in chosen.windows(2) {
        assert!(pair[0].seconds <= pair[1].seconds);
        assert!(pair[0].robustness <= pair[1].robustness + report.noise.error);
    }
}

#[test]
fn the_page_states_cost_and_gain_of_each_effort() {
    let report: TradeOffReport = serde_json::from_str(MEASURED).unwrap();
    let document = tradeoff_document(&report);
    let published = tables().find(|table| table.name == "tradeoff").expect("a published table");
    let efforts = published.picks.iter().filter(|pick| pick.0 == "Efforts").copied();
    let table = select(&document.to_markdown(), &efforts.collect::<Vec<_>>()).unwrap();
    assert!(PAGE.contains(&table), "the page lacks\n{table}");
}

/// Share of the engine's cost below which a model is preferred. Closer to the engine's cost, the
/// engine's smaller error among touching objects decides, not the noise of the measurement.
const WORTH: f64 = 0.9;

/// Returns the maximum number of objects for which `model` costs less than [`WORTH`] of `rival`'s
/// cost. Between measured numbers, costs are interpolated linearly in logarithms; beyond them
/// nothing is known.
fn cheaper_up_to(rows: &[ObjectCost], model: &str, rival: &str) -> u16 {
    let mut last: Option<(f64, f64)> = None;
    let mut most = 0;
    for row in rows.iter().filter(|row| row.model == model) {
        let same = |other: &&ObjectCost| other.objects == row.objects && other.model == rival;
        let other = rows.iter().find(same).expect("both were timed");
        let count = (row.objects as f64).ln();
        let excess = (row.seconds / (WORTH * other.seconds)).ln();
        if excess >= 0.0 {
            let crossing = last.map_or(0.0, |(before, was)| {
                (before + (count - before) * was / (was - excess)).exp()
            });
            return crossing.floor() as u16;
        }
        last = Some((count, excess));
        most = row.objects;
    }
    u16::try_from(most).expect("few objects")
}

#[test]
fn pushes_are_left_to_the_planar_engine_where_the_network_is_no_better() {
    let row = |objects, model: &str, seconds| ObjectCost {
        objects,
        model: model.into(),
        seconds,
        planar_ratio: 1.0,
    };
    let rows = |costs: [f64; 3]| {
        let own = [1, 3, 9].into_iter().zip(costs).map(|(n, cost)| row(n, "own", cost));
        own.chain([1, 3, 9].map(|n| row(n, "rival", 1.0))).collect::<Vec<_>>()
    };
    // Cost 0.05 n^2 passes the worth at the square root of 18.
    assert_eq!(cheaper_up_to(&rows([0.05, 0.45, 4.05]), "own", "rival"), 4);
    assert_eq!(cheaper_up_to(&rows([0.01, 0.09, 0.81]), "own", "rival"), 9);
    assert_eq!(cheaper_up_to(&rows([2.0, 3.0, 4.0]), "own", "rival"), 0);

    let report: TradeOffReport = serde_json::from_str(MEASURED).unwrap();
    // The more accurate model is used as far as it was measured. Otherwise the costs of the
    // analytic model determine the limit, also for the network, which contains it.
    for effort in Effort::ALL {
        let spec = effort.model();
        let (few, others) = (spec.first(), spec.others());
        let rival = ModelSpec::from(others[0].kind.clone()).to_string();
        let touching = |name: &str| {
            let row = report.predictors.iter().find(|row| row.model == name).unwrap();
            row.suites[1].position.as_ref().unwrap().mean
        };
        let most = match touching("network") < touching(&rival) {
            true => {
                let most = report.objects.iter().map(|row| row.objects).max().unwrap();
                u16::try_from(most).expect("few objects")
            }
            false => cheaper_up_to(&report.objects, "prior", &rival),
        };
        assert_eq!(few.up_to, Some(most), "{effort}: {spec}");
    }
}

#[test]
fn stated_model_errors_equal_the_measured_errors() {
    let report: TradeOffReport = serde_json::from_str(MEASURED).unwrap();
    let library = ToolLibrary::embedded().unwrap();
    let kinds = [SuiteKind::Single, SuiteKind::Touching];
    let suites = kinds.map(|kind| Suite::draw(kind, &library, 5, 1));
    for name in ["planar", "planar,step=1/120", "planar,step=1/60", "planar,step=1/30"] {
        let row = report.predictors.iter().find(|row| row.model == name).unwrap();
        for (suite, measured) in suites.iter().zip(&row.suites) {
            let case = &suite.cases[0];
            let job = Job::stated(&case.scene, case.motion.clone());
            let expected = model(name).trust(&case.scene, &job).error().expect("it was measured");
            let measured = measured.position.as_ref().unwrap();
            assert!((expected.median - measured.median).abs() < 0.5e-5, "{name}: {expected:?}");
            assert!((expected.p95 - measured.p95).abs() < 0.5e-5, "{name}: {expected:?}");
        }
    }
    // The shipped errors of analytic model and network agree with the results on four times as many
    // pushes.
    let results = include_str!("../../results/prediction.md");
    for name in ["prior", "network"] {
        let rows: Vec<Vec<&str>> = results
            .lines()
            .filter(|line| line.starts_with(&format!("|{name}|")))
            .map(|line| line.split('|').map(str::trim).collect())
            .collect();
        for (suite, row) in suites.iter().zip([&rows[0], &rows[2]]) {
            let case = &suite.cases[0];
            let job = Job::stated(&case.scene, case.motion.clone());
            let expected = model(name).trust(&case.scene, &job).error().expect("it was measured");
            assert_eq!(format!("{:.2}", 1e3 * expected.median), row[3], "{name}");
            assert_eq!(format!("{:.2}", 1e3 * expected.p95), row[4], "{name}");
        }
    }
}
