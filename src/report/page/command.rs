//! The command line that makes a plan's replays again.

use crate::scene::{Plan, PushForm};

/// `pushplan predict` of a plan's pushes on a task file; `options` go between.
///
/// A plan without pushes has none to predict, and the task is solved instead.
pub fn predict_command(task: &str, options: &[String], plan: &Plan) -> String {
    let verb = if plan.pushes.is_empty() { "solve" } else { "predict" };
    let mut words = vec!["pushplan".to_owned(), verb.to_owned(), quoted(task)];
    words.extend(options.iter().map(|option| quoted(option)));
    if !plan.pushes.is_empty() {
        words.extend(["--tool".to_owned(), quoted(&plan.tool)]);
        words.extend(["--grip-yaw-deg".to_owned(), plan.grip_yaw.to_degrees().to_string()]);
    }
    for (k, push) in plan.pushes.iter().enumerate() {
        let start = match (plan.form, k) {
            // A chained push goes on where the one before it ended, to the last digit.
            (PushForm::Chained, 1..) => String::new(),
            _ => format!("start={},{} ", push.start.x, push.start.y),
        };
        let (direction, length, speed) = (push.direction.to_degrees(), push.length, push.speed);
        let push = format!("{start}direction_deg={direction} length={length} speed={speed}");
        words.extend(["--push".to_owned(), quoted(&push)]);
    }
    words.join(" ")
}

/// A word as a POSIX shell takes it whole.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;
    use crate::scene::Push;

    #[test]
    fn a_plan_becomes_a_command_that_a_shell_takes_as_it_is() {
        let start = Vector::new(0.5, 0.25);
        let push = Push { start, direction: std::f64::consts::PI, length: 0.1, speed: 0.1 };
        let plan = Plan {
            tool: "bob's hook".to_owned(),
            grip_yaw: 0.0,
            form: PushForm::Chained,
            lift: 0.002,
            pushes: vec![push, push],
        };
        insta::assert_snapshot!(
            predict_command("my tasks/a.yaml", &["--tools=mine".to_owned()], &plan),
            @r"pushplan predict 'my tasks/a.yaml' --tools=mine --tool 'bob'\''s hook' --grip-yaw-deg 0 --push 'start=0.5,0.25 direction_deg=180 length=0.1 speed=0.1' --push 'direction_deg=180 length=0.1 speed=0.1'"
        );
        let nothing = Plan { pushes: Vec::new(), ..plan };
        assert_eq!(predict_command("a.yaml", &[], &nothing), "pushplan solve a.yaml");
    }
}
