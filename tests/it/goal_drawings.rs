//! Snapshots of the drawing of every kind of goal: the lines of the picture in the goal's colour,
//! and the goal in the data of the page, which the 3-D view and the browser draw as well.

use pushplan::task::Task;
use pushplan_report::{ScenePicture, task_stage};

/// Colour of goals in pictures.
const COLOUR: &str = "#9c36b5";

/// A kind of goal, with a shipped task and replacements in its text.
type Kind = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

const KINDS: [Kind; 10] = [
    ("place", "pull-back", &[]),
    ("heading", "turn-the-box", &[]),
    ("symmetric heading", "two-places", &[]),
    ("region", "into-the-tray", &[]),
    ("outside a region", "into-the-tray", &[("{area: {", "{outside: true, area: {")]),
    ("gap", "fence-flush", &[("{to: fence, max: 0.003}", "{to: fence, min: 0.02, max: 0.05}")]),
    ("edge", "cork-over-the-edge", &[]),
    ("joint", "open-door", &[]),
    ("coverage", "cover-the-mark", &[]),
    ("height", "levers/walled-in", &[]),
];

#[test]
fn every_kind_of_goal_has_its_drawing() {
    for (kind, name, changes) in KINDS {
        let file = format!("{}/tasks/{name}.yaml", crate::ROOT);
        let mut text = std::fs::read_to_string(&file).expect("a shipped task");
        for (old, new) in changes {
            assert!(text.contains(old), "{name}: no {old}");
            text = text.replace(old, new);
        }
        let task = Task::parse(&text, &file).unwrap_or_else(|fault| panic!("{kind}: {fault}"));
        let picture = ScenePicture {
            title: kind.to_owned(),
            notes: Vec::new(),
            scene: &task.scene,
            goals: task.shown_goals(),
            reach: None,
            motions: &[],
            tracks: Vec::new(),
        };
        let svg = picture.to_svg();
        let drawn: Vec<&str> = svg.lines().filter(|line| line.contains(COLOUR)).collect();
        let words = svg.lines().filter(|line| line.contains(">goal")).collect::<Vec<_>>();
        let goals = serde_json::to_string_pretty(&task_stage(&task)["goals"]).expect("plain data");
        let all = format!("{}\n{}\n{goals}", drawn.join("\n"), words.join("\n"));
        insta::assert_snapshot!(kind.replace(' ', "_"), all);
    }
}
