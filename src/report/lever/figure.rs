//! The picture of a lever-up.

use crate::report::document::Figure;
use crate::report::picture::LeverPicture;
use crate::scene::{LeverMotion, LeverPlan, LeverScene, Task, Tool};

use super::words::{goal_line, plan_line};

/// The picture of a plan as it was replayed, with lines below its title; its file is named `name`.
pub fn lever_figure(
    task: &Task,
    (tool, plan): (&Tool, &LeverPlan),
    motion: &LeverMotion,
    lines: &[String],
    name: &str,
) -> Figure {
    let scene = LeverScene::with(&task.scene, tool);
    let notes = [format!("goal: {}", goal_line(task))].into_iter().chain(lines.iter().cloned());
    let picture = LeverPicture {
        title: format!("{}: {}", task.name, plan_line(task, plan)),
        notes: notes.collect(),
        scene: &scene,
        lever: &plan.lever,
        goal: &task.goal,
        motion,
    };
    Figure::svg(name, picture.to_svg())
}
