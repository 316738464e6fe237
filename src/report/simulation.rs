//! One simulation of an action or a plan.

use serde_json::json;

use crate::asset::TrajectoryFile;
use crate::scene::{Engine, Outcome};

use super::document::{Document, Figure, Section};
use super::number::millimetres;
use super::picture::{ScenePicture, Source, Track};
use super::plan_picture::{moving_figure, space_figures};
use super::plan_text::{goal_line, plan_line, plan_sections};

/// A simulation in `engine` with its picture, whose file is named `name`; `animate` adds one that
/// moves.
pub fn simulation_document(
    file: &TrajectoryFile,
    engine: Engine,
    name: &str,
    animate: bool,
) -> Document {
    let TrajectoryFile { task, tools, plan, trajectory, .. } = file;
    let end = trajectory.outcome();
    let error = task.goal.error(end);
    let time = trajectory.frames.last().map_or(0.0, |frame| frame.time);
    let figures = match (task.in_space() || plan.levers(), tools.first()) {
        (true, _) | (false, None) => {
            space_figures(task, (plan, tools), trajectory, &[], (name, animate))
        }
        (false, Some(tool)) => {
            let motion = plan.motion(tool);
            let source = Source::Simulated(engine);
            let picture = ScenePicture {
                title: format!("{}: {}", task.name, plan_line(plan)),
                notes: vec![format!("{} from the goal at rest", millimetres(error))],
                scene: &task.scene,
                goal: Some(&task.goal),
                robot: Some(&task.robot),
                motion: Some(&motion),
                tracks: vec![Track { source, trajectory }],
            };
            let mut figures = vec![Figure::svg(name, picture.to_svg())];
            if animate {
                let moving = (engine, trajectory);
                figures.push(moving_figure(task, plan, &motion, moving, name));
            }
            figures
        }
    };
    let outcome = Outcome::judge(&task.scene, &task.goal, trajectory);
    let came = match (outcome.lying, outcome.reached) {
        (None, _) => format!("{} from the goal", millimetres(error)),
        (Some(_), true) => "reaches the goal".to_owned(),
        (Some(_), false) => "misses the goal".to_owned(),
    };
    let frames = trajectory.frames.len();
    let line = format!("{frames} frames, {time:.2} s; {came}: {}", goal_line(task));
    let end_section = Section { lines: vec![line], figures, ..Section::default() };
    Document {
        title: plan_line(plan),
        sections: plan_sections(plan).into_iter().chain([end_section]).collect(),
        json: json!({
            "task": task.name, "engine": engine, "plan": plan,
            "frames": trajectory.frames.len(), "state": end, "goal_error": error,
            "warnings": trajectory.warnings,
        }),
        ..Document::default()
    }
}
