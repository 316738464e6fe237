//! Every shipped file loads, and broken files are refused with all their faults.

mod faults;
mod joints;
mod prisms;
mod recordings;
mod robustness;
mod saved;
#[path = "../../crates/lab/fuzz/snippets.rs"]
mod snippets;

use std::path::{Path, PathBuf};

use pushplan::asset::{ToolLibrary, load_task};
use pushplan::geometry::Shape;
use pushplan::{scene::Tool, task::Task};

use crate::ROOT;

/// Returns a folder of the repository.
fn folder(name: &str) -> PathBuf {
    Path::new(ROOT).join(name)
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
fn every_shipped_task_is_an_example() {
    let there = [tasks_in("tasks"), tasks_in("tasks/levers")].concat();
    let stem = |path: &PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
    let names: Vec<String> = there.iter().map(stem).collect();
    assert_eq!(Task::examples().collect::<Vec<_>>(), names);
    for (name, path) in names.iter().zip(&there) {
        assert_eq!(Task::example(name).unwrap(), Task::load(path).unwrap());
    }
    let faults = Task::example("pul-back").unwrap_err().to_string();
    assert!(faults.contains("did you mean `pull-back`?"), "{faults}");
}

#[test]
fn every_shipped_task_loads_and_names_tools_that_exist() {
    let library = ToolLibrary::embedded().unwrap();
    let mut count = 0;
    for path in shipped_tasks() {
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
        assert_eq!(tool.parts().len(), 4);
        for (part, x) in tool.parts().iter().zip([0.12, 0.26, 0.40]) {
            assert_eq!(part.shape, Shape::Cuboid { size: [0.14, 0.08, 0.05] });
            assert_eq!([part.pose.position.x, part.pose.position.y], [x, 0.0]);
        }
        let part = &tool.parts()[3];
        assert_eq!([part.pose.position.x, part.pose.position.y], last);
        assert_eq!(part.pose.heading, f64::to_radians(turn));
    }
}

/// Returns every task file; pictures are stored next to some of them.
pub fn shipped_tasks() -> Vec<PathBuf> {
    tasks_in("tasks")
}

fn tasks_in(name: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder(name)).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "yaml"));
    paths.sort();
    paths
}
