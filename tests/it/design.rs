//! Proposals of tools for tasks that no shipped tool solves.

use std::fs;
use std::sync::Arc;

use rayon::ThreadPoolBuilder;
use serde_json::Value as Json;
use tempfile::TempDir;

use pushplan::Situation;
use pushplan::progress::NoProgress;
use pushplan::{Effort, PlanStatus, Planner, Task, Tool, ToolLibrary};
use pushplan_design::{Design, DesignSettings, design};
use pushplan_report::{PageView, Recipe, design_page};

use crate::program::{run, stderr};

/// Can behind a slot in a wall, 3 cm wide, that no hand reaches over; the narrowest shipped handle
/// needs 4 cm.
const SLOT: &str = "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.10}}, mass: 0.3, friction: 0.4, position: [0.90, 0.0]}
  obstacles:
    - {name: left, size: [0.03, 1.0, 0.15], position: [0.76, 0.515]}
    - {name: right, size: [0.03, 1.0, 0.15], position: [0.76, -0.515]}
robot: {reach: {min: 0.25, max: 0.6}}
tools: all
pushes: {max_count: 1}
goal: {object: can, position: [1.0, 0.0], tolerance: 0.02}
";

fn designed(text: &str, settings: &DesignSettings) -> (Task, Design) {
    let library = ToolLibrary::embedded().unwrap();
    let task = Task::parse(text, "slot.yaml").unwrap();
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    let design = design(&planner, &task, &library, settings, &NoProgress).unwrap();
    (task, design)
}

#[test]
fn a_tool_is_proposed_that_passes_where_no_shipped_one_does() {
    let (task, design) = designed(SLOT, &DesignSettings::looking_at(120));
    assert_eq!(design.known.status, PlanStatus::NoPlan);
    assert_eq!(design.status(), PlanStatus::Solved);
    let tool = design.proposal.as_ref().map(|proposal| &proposal.tool).unwrap();
    // A single bar suffices, so no tool of several parts is proposed.
    assert_eq!(tool.outline().len(), 1, "{}", tool.to_yaml().unwrap());
    let read = Tool::parse(&tool.to_yaml().unwrap(), "tool.yaml").unwrap();
    assert_eq!(read, **tool);

    // The page has the sizes of the tool, and a row for every existing tool.
    let best = design.best().best().unwrap();
    let replays = best.replays(&task, &Situation::stated(&task.scene));
    let page = design_page(&task, &design, &replays, &|_| Recipe::default(), PageView::Above);
    let data = page.split("id=\"data\">").nth(1).and_then(|rest| rest.split("</script>").next());
    let data: Json = serde_json::from_str(data.unwrap()).unwrap();
    assert_eq!(data["found"][0]["rows"].as_array().unwrap().len(), tool.parts().len());
    let rows = data["found"][1]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 1 + design.known.tools.len());
    assert_eq!(rows[0][0], format!("{} (proposed)", tool.name));
    assert!(data["description"].as_str().unwrap().contains("existing tools"), "{}", data["task"]);

    // The tool read back from its file gives the same result.
    let library = ToolLibrary::embedded().unwrap().with(Arc::new(read)).unwrap();
    let planner = Planner::for_effort(Effort::Standard).unwrap().build();
    let solution = planner.solve(&task, &library).unwrap();
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().unwrap();
    assert_eq!(best.plan.tool(), tool.name);
}

#[test]
fn a_time_limit_ends_the_search_with_the_best_so_far() {
    let folder = TempDir::new().expect("a folder");
    let task = folder.path().join("slot.yaml");
    fs::write(&task, SLOT).expect("a file");
    let (task, out) = (task.to_str().expect("UTF-8"), folder.path().to_str().expect("UTF-8"));
    let all = ["design", task, "--candidates", "1000000", "--json", "--out", out];
    let began = std::time::Instant::now();
    let output = run(&[&all[..], &["--time-limit", "2"]].concat());
    // Units of work that have begun are finished.
    assert!(began.elapsed().as_secs() < 60, "{:?}", began.elapsed());
    let design: Json = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(design["stopped"], true, "{}", stderr(&output));
    let output = run(&["design", task, "--time-limit", "0"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn proposals_do_not_depend_on_the_number_of_threads() {
    let settings = DesignSettings { solved: 1, ..DesignSettings::looking_at(60) };
    let [one, three] = [1, 3].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| designed(SLOT, &settings).1)
    });
    assert_eq!(one.spent, three.spent);
    assert_eq!(one.proposal.map(|one| one.tool), three.proposal.map(|one| one.tool));
}

#[test]
fn nothing_is_proposed_where_a_shipped_tool_leaves_nothing_to_gain() {
    let easy = "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.10}}, mass: 0.3, friction: 0.4, position: [0.55, 0.0]}
robot: {reach: {min: 0.25, max: 0.7}}
tools: [finger]
goal: {object: can, position: [0.65, 0.0], tolerance: 0.03}
";
    let (_, design) = designed(easy, &DesignSettings::looking_at(10));
    assert_eq!((design.status(), design.spent.looked_at), (PlanStatus::Solved, 0));
    assert!(design.proposal.is_none());
}

#[test]
fn the_command_writes_a_tool_that_check_and_solve_take() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (task, out) = (path("slot.yaml"), path("plans"));
    fs::write(&task, SLOT).unwrap();
    let options = ["--candidates", "80", "--effort", "draft", "--json", "--out", &out];
    let output = run(&[&["design", &task][..], &options].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let json: Json = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&json["status"], &json["known"]["status"]), (&"solved".into(), &"no_plan".into()));
    let name = json["tool"]["name"].as_str().unwrap();
    assert_eq!(name, "slot-bar");
    let written: Vec<&str> =
        json["files"].as_array().unwrap().iter().filter_map(Json::as_str).collect();
    let ends = ["tools/slot-bar.yaml", "slot-bar.plan.json", "slot-bar.svg", "slot-bar.html"];
    assert_eq!(written.len(), ends.len());
    assert!(written.iter().zip(ends).all(|(file, end)| file.ends_with(end)), "{written:?}");

    assert_eq!(run(&["check", written[0], written[1]]).status.code(), Some(0));
    assert_eq!(run(&["verify", written[1], "--out", &out]).status.code(), Some(0));
    let tools = path("plans/tools");
    let output = run(&["solve", &task, "--more-tools", &tools, "--json", "--out", &out]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));

    let output = run(&["design", "--example", "raise-plate", "--out", &out]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("levering"), "{}", stderr(&output));
}

#[test]
fn a_task_that_no_tool_solves_ends_as_solve_does() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().to_str().unwrap();
    let options = ["--candidates", "30", "--effort", "draft", "--out", out];
    let output = run(&[&["design", "tasks/boxed-in.yaml"][..], &options].concat());
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(!folder.path().join("tools").exists());
}
