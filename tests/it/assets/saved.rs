//! Files that the program writes: read back bit for bit, refused when damaged, complete or absent.

use insta::assert_snapshot;
use pushplan::asset::{
    Kind, PLAN_VERSION, PlanFile, ToolLibrary, TrajectoryFile, check, write_atomic,
};
use pushplan::geometry::{Pose, Vector};
use pushplan::{
    outcome::{
        Contact, Evidence, Force, Frame, Miss, Outcome, Perturbation, Spread, Trajectory, Verdict,
        Warning,
    },
    scene::{Body, Engine, HeadSpread, ModelKind, Narrowed, TableFit, Tool},
    task::{Plan, Push, Step, Task},
};

use super::{folder, shipped_tasks};

/// Returns a plan file with all keys for the task `name`.
pub fn plan_file(name: &str) -> PlanFile {
    let library = ToolLibrary::embedded().unwrap();
    let task = Task::load(folder("tasks").join(name)).unwrap();
    let tool = task.tools(&library).unwrap()[0].clone();
    let push = Push { start: Vector::new(0.1, 0.2 / 3.0), direction: 1.1, length: 0.2, speed: 0.1 };
    let (yaw, rules) = (90f64.to_radians(), &task.pushes);
    let plan = Plan::pushing(&tool.name, yaw, rules.form, rules.lift, [push; 2]);
    let goals = task.goals.iter().map(|goal| Miss {
        object: goal.object,
        error: 0.1,
        heading_error: Some(0.2),
        score: 2.5,
        raised: None,
    });
    let outcome = Outcome { state: task.scene.start(), goals: goals.collect(), reached: false };
    let evidence = Evidence {
        engine: Engine::Spatial,
        perturbation: Perturbation::Nominal,
        outcome: outcome.clone(),
        warnings: vec![Warning::NotAtRest { waited: 3.0 }],
        trajectory: None,
        force: Some(Force { peak: 9.6, lasting: 0.7 }),
    };
    let perturbed =
        Evidence { perturbation: Perturbation::Perturbed { draw: 2 }, ..evidence.clone() };
    let verdict = Verdict::judge(Vec::new(), vec![evidence, perturbed], 0.75);
    PlanFile {
        joints: None,
        task,
        tools: vec![tool],
        plan,
        model: Some(ModelKind::PLANAR.into()),
        fit: Some(TableFit {
            weights: "0123".into(),
            head: vec![0.1, -1.0 / 3.0],
            spread: HeadSpread {
                prior: 0.08,
                directions: vec![Narrowed { left: 0.2, direction: vec![0.6, -0.8] }],
            },
            noise: 6.2e-4,
            pushes: 20,
            ..TableFit::default()
        }),
        predicted: Some(outcome),
        verdict: Some(verdict),
    }
}

pub fn trajectory_file(name: &str) -> TrajectoryFile {
    let PlanFile { task, tools, plan, .. } = plan_file(name);
    let frame = |time, stroke| Frame {
        time,
        stroke,
        tool: Pose::new(0.1, 0.7, -3.0),
        blade: None,
        state: task.scene.start(),
    };
    let contact = Contact { frame: 1, object: 0, with: Body::Part(0) };
    let trajectory = Trajectory {
        lifts: Vec::new(),
        spreads: vec![Spread { position: 1e-3, heading: 0.02 }],
        by: ModelKind::PLANAR.into(),
        frames: vec![frame(0.0, 0), frame(0.1, 0), frame(0.3, 1)],
        contacts: vec![contact],
        warnings: vec![Warning::NotFinite],
        force: Some(Force { peak: 12.5, lasting: 0.1 + 0.2 }),
    };
    TrajectoryFile { task, tools, plan, trajectory }
}

#[test]
fn written_files_read_back_bit_by_bit() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("file.json");
    for task in shipped_tasks() {
        let name = task.file_name().unwrap().to_string_lossy().into_owned();
        let plan = plan_file(&name);
        plan.write(&path).unwrap();
        assert_eq!(PlanFile::load(&path).unwrap(), plan);
        assert_eq!(check(&path, None).unwrap(), Kind::Plan);
        let trajectory = trajectory_file(&name);
        trajectory.write(&path).unwrap();
        assert_eq!(TrajectoryFile::load(&path).unwrap(), trajectory);
        assert_eq!(check(&path, None).unwrap(), Kind::Trajectory);
    }
    assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 1, "nothing is left behind");
}

/// Returns the message for a plan file with `old` replaced by `new`.
fn damaged(old: &str, new: &str) -> String {
    damaged_in(&PlanFile { fit: None, ..plan_file("pull-back.yaml") }, old, new)
}

fn damaged_in(file: &PlanFile, old: &str, new: &str) -> String {
    let text = serde_json::to_string(file).unwrap();
    assert!(text.contains(old), "{old} is not in {text}");
    PlanFile::parse(&text.replacen(old, new, 1), "p.json").unwrap_err().to_string()
}

#[test]
fn a_plan_file_whose_fit_was_changed_is_refused() {
    let file = plan_file("pull-back.yaml");
    let message = damaged_in(&file, "\"pushes\":20", "\"pushes\":90");
    assert!(message.contains("the fit is damaged"), "{message}");
}

#[test]
fn damaged_plan_files_are_refused() {
    let version = format!("\"schema_version\":{PLAN_VERSION}");
    assert_snapshot!(damaged(&version, "\"schema_version\":7"), @r#"
    p.json:1:19: error: expected the schema version 2, found the number 7
      help: the file is from another version of pushplan; create it again with this one
    "#);
    assert_snapshot!(damaged("\"grip_yaw\"", "\"gripyaw\""), @r#"
    p.json:1:84: error: unknown key `gripyaw`
      help: did you mean `grip_yaw`?
    "#);
    assert_snapshot!(damaged("\"length\":0.2", "\"length\":-0.2"), @r#"
    p.json:1:197: error: expected a positive number from 0.0001 to 100, found the number -0.2
      help: lengths are in metres, speeds in m/s
    "#);
    assert_snapshot!(damaged("\"length\":0.2", "\"length\":null"), @r#"
    p.json:1:197: error: expected a positive number from 0.0001 to 100, found nothing
      help: remove the key, or write its value after it
    "#);
    assert_snapshot!(damaged("\"length\":0.2", "\"length\":1e999"), @r#"
    p.json:1:198: error: not valid JSON: number out of range
      help: write a number that is smaller than 1e308
    "#);
    assert_snapshot!(damaged("\"mass\":0.4", "\"mass\":-1"), @r#"
    p.json:1:2394: error: expected a mass in kg from 0.001 to 1000, found the number -1
      help: masses are in kilograms: 250 g is 0.25
    "#);
    assert_snapshot!(damaged("\"push\":{\"tool\":\"stick\"", "\"push\":{\"tool\":\"rake\""), @r#"
    p.json:1:42: error: the plan uses `rake`, the file holds `stick`
      help: the file mixes two plans; create it again
    "#);
    assert_snapshot!(damaged("\"velocities\":[", "\"velocities\":[{\"linear\":[0,0],\"angular\":0},"), @r#"
    p.json:1:412: error: expected 1 velocities, one per object, found 2
      help: the file is damaged; create it again
    "#);
    assert_snapshot!(damaged("\"not_at_rest\"", "\"not_at_all\""), @r#"
    p.json:1:685: error: unknown variant `not_at_all`, expected one of `outside_range`, `declined`, `not_at_rest`, `doubtful`, `not_finite`, `stopped`, `toppled`, `jammed`, `off_table`, `not_kept`, `kept_out`, `fell`, `hangs`, `too_much_force`, `hard_push`, `out_of_reach`, `through_obstacle`, `hand_through`, `no_way`, `not_lifted`, `arm`, `forbidden_tool`, `forbidden_yaw`, `too_many_pushes`, `too_many_tool_changes`, `forbidden_push`, `cannot_lever`, `slipped`, `strained`, `set_down_on`, `pressed`, `overlap`, `loose_joint`, `differs`, `simulated`, `refused`, `guessed`, `squeezed`, `near_edge`
      help: the file is damaged or from another version; create it again
    "#);
    assert_snapshot!(damaged("\"kind\":\"plan\"", "\"kind\":\"trajectory\""), @r#"
    p.json:1:39: error: expected `plan`, found `trajectory`
      help: use `plan`
    "#);
    assert_snapshot!(damaged("{", ""), @r#"
    p.json:1:17: error: not valid JSON: trailing characters
      help: check indentation, brackets and quotes around this place
    "#);
}

#[test]
fn unreadable_values_are_not_written() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("plan.json");
    std::fs::write(&path, "old").unwrap();
    let mut file = plan_file("pull-back.yaml");
    if let Step::Push(step) = &mut file.plan.steps[1] {
        step.push.length = f64::NAN;
    }
    let faults = file.write(&path).unwrap_err().to_string();
    assert!(faults.contains("expected a positive number"), "{faults}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
}

#[test]
fn a_file_that_cannot_be_written_leaves_nothing_behind() {
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("file");
    std::fs::write(&file, "").unwrap();
    let missing = place.path().join("missing/plan.json");
    let below_a_file = file.join("plan.json");
    let folder = place.path().join("folder");
    std::fs::create_dir_all(folder.join("inner")).unwrap();
    for path in [&missing, &below_a_file, &folder] {
        let faults = write_atomic(path, b"new").unwrap_err().to_string();
        let start = format!("{}: error: cannot write the file: ", path.display());
        assert!(faults.starts_with(&start), "{faults}");
    }
    assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 2);
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
}

#[cfg(target_os = "linux")]
#[test]
fn a_read_only_folder_is_reported() {
    // File permissions cannot be used, because they do not restrict the root user, who may run the
    // tests.
    let faults = write_atomic("/proc/plan.json", b"new").unwrap_err().to_string();
    assert!(faults.starts_with("/proc/plan.json: error: cannot write the file: "), "{faults}");
}

#[cfg(unix)]
#[test]
fn a_written_file_replaces_the_old_one_and_can_be_read_by_others() {
    use std::os::unix::fs::PermissionsExt;
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("plan.json");
    std::fs::write(&path, "old and longer").unwrap();
    write_atomic(&path, b"new").unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "new");
    let by_hand = place.path().join("by-hand");
    std::fs::write(&by_hand, "").unwrap();
    let mode = |path| std::fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&path), mode(&by_hand));
}

#[test]
fn a_tool_built_in_code_reads_back_with_the_same_joints() {
    let mut file = plan_file("pull-back.yaml");
    let tool = Tool::clone(&file.tools[0]);
    let mut parts = tool.parts().to_vec();
    parts[0].pose.position.y += 1.0;
    let tool = Tool::joined(tool.name, parts, &[[0, 1]]).unwrap().held_at(tool.grip).friction(0.3);
    file.tools = vec![tool.into()];
    let text = serde_json::to_string(&file).unwrap();
    assert_eq!(PlanFile::parse(&text, "p.json").unwrap().tools, file.tools);
}
