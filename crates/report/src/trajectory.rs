//! Pictures of one trajectory of an action or a plan.

use pushplan::asset::TrajectoryFile;
use pushplan::{outcome::Trajectory, scene::ModelKind};

use super::document::Figure;
use super::number::millimetres;
use super::picture::{ScenePicture, Source, Track};
use super::plan_picture::{moving_figure, space_figures};
use super::plan_text::plan_line;

/// Returns a picture of a trajectory, with the file name `name`; `animate` adds an animation.
pub fn trajectory_figures(file: &TrajectoryFile, name: &str, animate: bool) -> Vec<Figure> {
    let TrajectoryFile { task, tools, plan, trajectory, .. } = file;
    let flat = trajectory.outcome().space.is_none();
    let (true, Some(motions)) = (flat, plan.slides(tools)) else {
        return space_figures(task, (plan, tools), trajectory, &[], (name, animate));
    };
    let error = task.goals[0].error(trajectory.outcome());
    let source = source(trajectory);
    let picture = ScenePicture {
        title: format!("{}: {}", task.name, plan_line(plan)),
        notes: vec![format!("final error {}", millimetres(error))],
        scene: &task.scene,
        goals: task.shown_goals(),
        reach: Some(task.annulus()),
        motions: &motions,
        tracks: vec![Track { source, trajectory }],
    };
    let mut figures = vec![Figure::svg(name, picture.to_svg())];
    if animate {
        figures.push(moving_figure(task, plan, &motions, (source, trajectory), name));
    }
    figures
}

/// Returns the source of a trajectory: prediction or engine.
fn source(trajectory: &Trajectory) -> Source {
    match trajectory.by.first().kind {
        ModelKind::Simulated { engine, .. } => Source::Simulated(engine),
        _ => Source::Predicted,
    }
}
