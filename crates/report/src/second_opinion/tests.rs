//! Lines of a second opinion.

use super::*;

fn opinion(passed: bool, runs: &[(f64, Option<&str>)]) -> SecondOpinion {
    let runs: Vec<TimedReplay> = runs
        .iter()
        .map(|(timestep, failure)| TimedReplay {
            timestep: *timestep,
            failure: failure.map(str::to_owned),
        })
        .collect();
    SecondOpinion {
        engine: "MuJoCo 4.0.0".to_owned(),
        passed,
        failure: runs.last().and_then(|run| run.failure.clone()),
        error: Some(0.0123),
        heading_error: None,
        difference: Some(4e-4),
        runs,
    }
}

#[test]
fn a_line_has_the_verdict_the_reason_and_time_steps_that_differ() {
    let misses = Some("misses the goal");
    let lines = [
        opinion(true, &[(2.5e-4, None)]),
        opinion(false, &[(2.5e-4, None)]),
        opinion(false, &[(2.5e-4, misses), (1.25e-4, misses)]),
        opinion(true, &[(2.5e-4, misses), (1.25e-4, None), (6.25e-5, None)]),
    ];
    insta::assert_snapshot!(lines.map(|one| one.line()).join("\n"), @r"
    MuJoCo 4.0.0 passed: reaches the goal, 0.4 mm from the end in 3-D
    MuJoCo 4.0.0 failed: reaches the goal, but breaks a rule of the task, 0.4 mm from the end in 3-D
    MuJoCo 4.0.0 failed: misses the goal (error 12.3 mm)
    MuJoCo 4.0.0 passed: reaches the goal, 0.4 mm from the end in 3-D; results differ with the time step: misses the goal at 0.25 ms, reaches the goal at 0.125 ms, reaches the goal at 0.0625 ms
    ");
}
