//! Every shipped file loads, and broken files are refused with all their faults.

use std::path::PathBuf;

use pushplan::asset::{Kind, PlanFile, ToolLibrary, TrajectoryFile, check, load_task};
use pushplan::geometry::{Pose, Vector};
use pushplan::scene::{
    Body, Contact, Engine, Evidence, Frame, Outcome, Plan, Push, Task, Tool, Trajectory, Verdict,
    Warning,
};

fn folder(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(name)
}

#[test]
fn every_shipped_tool_is_embedded() {
    let embedded = ToolLibrary::embedded().unwrap();
    let loaded = ToolLibrary::load(folder("tools")).unwrap();
    let names = |library: &ToolLibrary| -> Vec<String> {
        library.iter().map(|tool| tool.name.clone()).collect()
    };
    assert_eq!(names(&embedded), names(&loaded));
    assert!(embedded.len() >= 10);
    for tool in &loaded {
        assert_eq!(embedded.get(&tool.name), Some(tool));
        let file = folder("tools").join(format!("{}.yaml", tool.name));
        assert_eq!(&Tool::load(file).unwrap(), &**tool, "the file is named after its tool");
    }
}

#[test]
fn every_shipped_task_loads_and_names_tools_that_exist() {
    let library = ToolLibrary::embedded().unwrap();
    let mut count = 0;
    for entry in std::fs::read_dir(folder("tasks")).unwrap() {
        let path = entry.unwrap().path();
        let task = load_task(&path, &library).unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(task.name, path.file_stem().unwrap().to_string_lossy());
        assert!(!task.description.is_empty(), "{}", task.name);
        assert!(!task.tools(&library).unwrap().is_empty());
        count += 1;
    }
    assert!(count >= 12, "{count} tasks");
}

#[test]
fn the_reference_tools_have_the_reference_geometry() {
    let library = ToolLibrary::embedded().unwrap();
    for (name, last, turn) in [
        ("stick", [0.54, 0.0], 0.0),
        ("l-hook", [0.43, 0.12], 90.0),
        ("inverse-l", [0.43, -0.12], -90.0),
    ] {
        let tool = library.get(name).unwrap();
        assert_eq!(tool.parts.len(), 4);
        for (part, x) in tool.parts.iter().zip([0.12, 0.26, 0.40]) {
            assert_eq!(part.size, [0.14, 0.08, 0.05]);
            assert_eq!([part.pose.position.x, part.pose.position.y], [x, 0.0]);
        }
        let part = &tool.parts[3];
        assert_eq!([part.pose.position.x, part.pose.position.y], last);
        assert_eq!(part.pose.heading, f64::to_radians(turn));
    }
}

/// A plan file with everything in it, for the task `name`.
fn plan_file(name: &str) -> PlanFile {
    let library = ToolLibrary::embedded().unwrap();
    let task = Task::load(folder("tasks").join(name)).unwrap();
    let tool = task.tools(&library).unwrap()[0].clone();
    let push = Push { start: Vector::new(0.1, 0.2 / 3.0), direction: 1.1, length: 0.2, speed: 0.1 };
    let plan = Plan {
        tool: tool.name.clone(),
        grip_yaw: 90f64.to_radians(),
        form: task.pushes.form,
        lift: task.pushes.lift,
        pushes: vec![push; 2],
    };
    let outcome =
        Outcome { state: task.scene.start(), error: 0.1, heading_error: Some(0.2), reached: false };
    let evidence = Evidence {
        engine: Engine::Spatial,
        disturbance: "nominal".into(),
        outcome: outcome.clone(),
        warnings: vec![Warning::NotAtRest { waited: 3.0 }],
    };
    let verdict = Verdict { passed: false, evidence: vec![evidence], robustness: Some(0.5) };
    PlanFile {
        task,
        tool,
        plan,
        model: Some("planar".into()),
        predicted: Some(outcome),
        verdict: Some(verdict),
    }
}

fn trajectory_file(name: &str) -> TrajectoryFile {
    let PlanFile { task, tool, plan, model, .. } = plan_file(name);
    let frame = |time, stroke| Frame {
        time,
        stroke,
        tool: Pose::new(0.1, 0.7, -3.0),
        state: task.scene.start(),
    };
    let contact = Contact { frame: 1, object: 0, with: Body::Part(0) };
    let trajectory = Trajectory {
        frames: vec![frame(0.0, 0), frame(0.1, 0), frame(0.3, 1)],
        contacts: vec![contact],
        warnings: vec![Warning::NotFinite],
    };
    TrajectoryFile { task, tool, plan, model, trajectory }
}

#[test]
fn written_files_read_back_bit_by_bit() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("file.json");
    for entry in std::fs::read_dir(folder("tasks")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
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
