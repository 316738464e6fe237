//! Tests of `recipe`.

use super::*;
use pushplan::geometry::Vector;

fn plan() -> Plan {
    let start = Vector::new(0.5, 0.25);
    let push = Push { start, direction: std::f64::consts::PI, length: 0.1, speed: 0.1 };
    Plan::pushing("bob's hook", 0.0, PushForm::Chained, 0.002, [push, push])
}

#[test]
fn a_plan_becomes_a_command_that_a_shell_takes_as_it_is() {
    let origin = Origin {
        task: TaskSource::of("my tasks/a.yaml"),
        tools: Some("mine".to_owned()),
        ..Origin::default()
    };
    insta::assert_snapshot!(
        origin.plan(&plan()).command,
        @r"pushplan predict 'my tasks/a.yaml' --tools mine --tool 'bob'\''s hook' --grip-yaw-deg 0 --push 'start=0.5,0.25 direction_deg=180 length=0.1 speed=0.1' --push 'direction_deg=180 length=0.1 speed=0.1'"
    );
    let nothing = Plan::default();
    let origin = Origin { task: TaskSource::of("a.yaml"), ..Origin::default() };
    assert_eq!(origin.plan(&nothing).command, "pushplan solve a.yaml");
    let origin = Origin { task: TaskSource::Example("pull-back".to_owned()), ..origin };
    let recipe = origin.plan(&nothing);
    assert_eq!(recipe.command, "pushplan solve --example pull-back");
    assert!(recipe.python.contains("task = pushplan.Task.example(\"pull-back\")"));
}

#[test]
fn a_run_becomes_a_script_where_python_can_do_the_same() {
    let origin = Origin { task: TaskSource::of("a.yaml"), ..Origin::default() };
    let setting = |option, keyword, value: &str| {
        let value = value.to_owned();
        Setting { option, keyword, value }
    };
    let usual =
        [setting("--effort", Some("effort"), "standard"), setting("--seed", Some("seed"), "3")];
    let Recipe { command, python } = origin.run("2", &usual);
    assert_eq!(command, "pushplan run a.yaml --world 2 --effort standard --seed 3");
    assert!(python.ends_with("print(pushplan.run(task, 2, effort=\"standard\", seed=3))"));
    assert_eq!(origin.run("hidden.yaml", &usual).python, "");
    assert_eq!(origin.run("2", &[setting("--probe-rule", None, "random")]).python, "");
}

#[test]
fn a_plan_becomes_a_script() {
    let origin = Origin {
        task: TaskSource::of("my \"tasks\"/a.yaml"),
        more_tools: Some("mine".to_owned()),
        model: Some(pushplan::scene::ModelKind::PLANAR.into()),
        ..Origin::default()
    };
    insta::assert_snapshot!(origin.plan(&plan()).python, @r#"
    import pushplan

    tools = pushplan.ToolLibrary.shipped().with_folder("mine")
    task = pushplan.Task.load("my \"tasks\"/a.yaml", tools)
    pushes = [
        pushplan.Push((0.5, 0.25), 3.141592653589793, length=0.1, speed=0.1),
        pushplan.Push(None, 3.141592653589793, length=0.1, speed=0.1),
    ]
    plan = pushplan.Plan.of(task, "bob's hook", pushes, grip_yaw=0, tools=tools)
    predicted = pushplan.predict(plan, "planar")
    print(f"predicted error: {1000 * predicted.error:.1f} mm")
    print(pushplan.verify(plan))
    "#);
}
