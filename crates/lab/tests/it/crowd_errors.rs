//! Errors on crowds: the ground truth has none, no motion has the motion as error, and the command
//! writes its measurements.

use pushplan::progress::NoProgress;
use pushplan::recording::Recording;
use pushplan::{
    effect::{Assuming, EffectModel, Simulated, Still},
    scene::{Assumptions, JointBelief},
    sim::Simulator,
};
use pushplan_act::judge::{ModelErrors, Trial, TrialErrors};
use pushplan_lab::bench::{CrowdFamily, CrowdReport, CrowdSet, crowd_cases};
use pushplan_lab::report::{crowd_document, evaluation_document};
use pushplan_lab::trivial::Projection;
use pushplan_learn::dataset::{DatasetConfig, Episode, JointRule, Preset, Solids};
use serde_json::Value as Json;

use crate::program::{self, stderr};

fn set(family: CrowdFamily, objects: usize) -> CrowdSet {
    CrowdSet { family, objects, joints: JointRule::Mixed, solids: Solids::Any }
}

fn trials(family: CrowdFamily, objects: usize, count: usize) -> Vec<Trial> {
    set(family, objects).draw(3, count, &NoProgress)
}

fn measured(model: impl EffectModel + 'static, trials: &[Trial]) -> ModelErrors {
    TrialErrors::of(String::new(), trials, &[Box::new(model)], &NoProgress).models.remove(0)
}

#[test]
fn the_truth_has_no_error_and_staying_errs_by_the_motion() {
    for (family, objects, count) in [(CrowdFamily::Dense, 8, 6), (CrowdFamily::Sparse, 6, 2)] {
        let trials = trials(family, objects, count);
        assert!(trials.iter().all(|trial| trial.scene.objects.len() == objects));
        let truth = measured(Simulated::new(Simulator::planar()), &trials);
        let end = truth.all.end.as_ref().expect("objects");
        assert_eq!((end.objects, end.mean, truth.failed), (objects * count, 0.0, 0));
        assert!(truth.curve.iter().all(|point| point.error == 0.0));
        assert!(truth.drift.iter().all(|drift| drift.max < 5e-3), "{:?}", truth.drift);
        assert!(truth.overlap < 0.02, "{}", truth.overlap);

        let still = measured(Still, &trials);
        let (all, moved) = (still.all.end.as_ref(), still.moved.end.as_ref());
        let (all, moved) = (all.expect("objects"), moved.expect("something moves"));
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(near(all.mean, all.motion) && near(all.relative, 1.0));
        assert!(near(all.relative_interval.low, 1.0) && near(all.relative_interval.high, 1.0));
        assert!(moved.objects <= all.objects && moved.motion >= all.motion);
        assert!(moved.objects > 0 && moved.motion > 0.01);
        let averaged = still.all.averaged.as_ref().expect("objects");
        assert!(near(averaged.mean, averaged.motion));
        assert_eq!(still.curve[0].error, 0.0);
        let last = still.curve.last().expect("a curve");
        assert!((last.horizon - 1.0).abs() < 1e-12 && (last.error - all.mean).abs() < 1e-12);
        assert!(still.drift.iter().all(|drift| drift.max < 1e-9));
        let joints: usize = trials.iter().map(|trial| trial.scene.joints.len()).sum();
        assert_eq!(still.drift.iter().map(|drift| drift.joints).sum::<usize>(), joints);
    }
}

#[test]
fn sets_differ_from_each_other_and_from_training_and_threads_change_nothing() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let trials = trials(CrowdFamily::Dense, 6, 6);
            (measured(Projection, &trials), trials)
        })
    };
    let one = with(1);
    assert_eq!(one, with(2));
    let sets =
        [CrowdFamily::Sparse, CrowdFamily::SparseLine, CrowdFamily::Dense].map(CrowdSet::all);
    assert!(sets.iter().all(|sets| sets.len() == 12));
    let first = |set: &CrowdSet| set.draw(3, 1, &NoProgress).remove(0).scene;
    let scenes: Vec<_> = sets[2].iter().map(first).collect();
    for (k, scene) in scenes.iter().enumerate() {
        assert!(scenes[..k].iter().all(|other| other.objects != scene.objects));
    }
    let training = DatasetConfig { seed: 3, preset: Preset::Dense, ..DatasetConfig::default() };
    let seen = Episode::of_crowd(&training, 0).scene;
    assert!(scenes.iter().all(|scene| scene.objects[0] != seen.objects[0]));
}

#[test]
fn a_recorded_simulation_is_judged_like_the_simulation() {
    let config = DatasetConfig { seed: 5, preset: Preset::Sparse, ..DatasetConfig::default() };
    let episode = Episode::of_crowd(&config, 1);
    let recording =
        Recording::of_frames("sparse", &episode.scene, &episode.motion, &episode.frames);
    let trial = Trial::of_recording(&recording);
    let strokes = |trial: &Trial| trial.motion.strokes.iter().filter(|s| s.settle).count();
    assert_eq!(strokes(&trial), episode.motion.strokes.len() - 1, "lifted between the strokes");
    let both =
        [trial, Trial::of_frames(episode.scene.clone(), episode.motion.clone(), &episode.frames)];
    let planar = Simulated::new(Simulator::planar());
    let still = both.clone().map(|trial| measured(Still, &[trial]).all.end.expect("objects"));
    assert!((still[0].motion - still[1].motion).abs() < 1e-9);
    let again = measured(planar, &both[..1]).all.end.expect("objects");
    // Frames end in other steps of the engine, so the results differ slightly.
    assert!(again.relative < 0.02, "{again:?}");
}

const NO_JOINTS: Assumptions =
    Assumptions { joints: Some(JointBelief::None), friction: None, start: None };

#[test]
fn reports_become_tables_and_curves_and_survive_json() {
    let set = set(CrowdFamily::Dense, 6);
    let drawn = set.draw(3, 3, &NoProgress);
    let models: Vec<Box<dyn EffectModel>> =
        vec![Box::new(Projection), Box::new(Assuming::new(Projection, NO_JOINTS)), Box::new(Still)];
    let report = CrowdReport::of((&set, 3), &drawn, &models, &NoProgress);
    let text = serde_json::to_string(&report).unwrap();
    let back: CrowdReport = serde_json::from_str(&text).unwrap();
    assert_eq!(serde_json::to_string(&back).unwrap(), text);
    let reports = [report];
    let document = crowd_document(&reports);
    assert!(document.title.starts_with("dense, 6 objects, mixed joints, any solids: 3 "));
    let table = document.sections[0].table.to_text();
    assert_eq!(table.lines().count(), 4);
    assert!(table.contains("projection,joints=none") && !table.contains("NaN"), "{table}");
    let document = evaluation_document(&[], &reports);
    assert!(document.to_text().contains("dense, 6 objects"));
    let charts: Vec<_> = document.figures().collect();
    assert_eq!(charts.len(), 1, "curves of each family that was measured");
    assert_eq!(charts[0].file_name(), "error-by-horizon-dense.svg");
    let chart = charts[0].to_svg();
    assert!(chart.contains("projection,joints=none") && !chart.contains("NaN"));
}

#[test]
fn the_network_is_timed_on_scenes_of_the_asked_size() {
    for case in crowd_cases(10, 7, 4) {
        assert_eq!((case.scene.objects.len(), case.motion.strokes.len()), (10, 1));
    }
}

#[test]
fn the_command_measures_sets_and_writes_what_it_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let run = |arguments: &[&str]| {
        let out = ["--out", out.to_str().expect("UTF-8")];
        program::run(&[&["evaluate"], arguments, &out].concat())
    };
    let one = ["--objects", "6", "--joints", "fixed", "--solids", "cylinders", "--count", "2"];
    let dense = run(&[&["projection", "--on", "dense"], &one[..], &["--json"]].concat());
    assert_eq!(dense.status.code(), Some(0), "{}", stderr(&dense));
    let brief = run(&[&["projection", "--on", "dense"], &one[..], &["--summary"]].concat());
    let brief = String::from_utf8(brief.stdout).expect("UTF-8");
    assert_eq!(brief.lines().filter(|line| line.starts_with("dense, 6 objects")).count(), 1);
    assert!(brief.contains("joints none") && !brief.contains("still"), "{brief}");
    let json: Json = serde_json::from_slice(&dense.stdout).expect("JSON alone");
    let report = &json["crowds"][0];
    assert_eq!(report["trajectories"], 2);
    assert_eq!(report["set"]["objects"], 6);
    let models = report["models"].as_array().expect("models");
    let names: Vec<&str> = models.iter().filter_map(|model| model["model"].as_str()).collect();
    let beside = "projection,joints=guessed projection,joints=none projection,joints=fixed prior \
                  follow still planar,friction=70% planar,friction=130% planar,start=100um";
    assert_eq!(names.join(" "), format!("projection {beside}"));
    let written = std::fs::read(out.join("evaluation.json"));
    let written: Json = serde_json::from_slice(&written.expect("a file")).expect("JSON");
    assert_eq!(written["crowds"], json["crowds"]);
    assert!(out.join("error-by-horizon-dense.svg").exists());

    for wrong in [&["--on", "spars"][..], &["--on", "dense", "--objects", "7"]] {
        assert_eq!(run(wrong).status.code(), Some(2));
    }
}
