//! Golden messages for faulty files. All faults of a file are reported at once, each with its
//! place, the expected and found content, and advice.

use insta::assert_snapshot;
use pushplan::asset::{PlanFile, ToolLibrary};
use pushplan::{scene::Tool, task::Task};

/// Valid task, modified by the tests.
const TASK: &str = "\
scene:
  table: {friction: 0.5}
  objects:
    - {name: can, shape: {cylinder: {radius: 0.05, height: 0.10}}, mass: 0.4, friction: 0.4, position: [0.55, 0.1]}
    - name: box
      shape: {cuboid: {size: [0.08, 0.1, 0.06]}}
      mass: 0.5
      friction: 0.3
      position: [0.7, -0.1]
  obstacles:
    - {name: wall, size: [0.02, 0.3, 0.1], position: [0.9, 0]}
robot: {home: [0.2, 0], reach: {min: 0.1, max: 0.5}}
tools: [stick, l-hook]
pushes: {form: placed, directions: principal, length: 0.2, speed: 0.1, max_count: 2}
goal: {object: can, position: [0.35, 0.1], tolerance: 0.05}
";

/// Valid tool, modified by the tests.
const TOOL: &str = "\
name: tee
friction: 0.4
parts:
  - {name: handle, size: [0.2, 0.04, 0.05], position: [0.1, 0, 0]}
  - {name: head, size: [0.04, 0.2, 0.05], position: [0.22, 0, 0]}
";

/// Replaces `old` with `new` in `text` for every pair; each `old` must occur.
fn spoiled(text: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(text.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1)
    })
}

/// Returns the message for the task with these changes.
fn task(changes: &[(&str, &str)]) -> String {
    Task::parse(&spoiled(TASK, changes), "t.yaml").unwrap_err().to_string()
}

/// Returns the message for the tool with these changes.
fn tool(changes: &[(&str, &str)]) -> String {
    Tool::parse(&spoiled(TOOL, changes), "t.yaml").unwrap_err().to_string()
}

#[test]
fn the_unspoiled_files_are_sound() {
    Task::parse(TASK, "t.yaml").unwrap();
    Tool::parse(TOOL, "t.yaml").unwrap();
    let round = ("size: [0.04, 0.2, 0.05]", "shape: {cylinder: {radius: 0.02, height: 0.05}}");
    Tool::parse(&spoiled(TOOL, &[round]), "t.yaml").unwrap();
}

#[test]
fn misspelled_and_unknown_keys() {
    assert_snapshot!(task(&[("mass: 0.4", "masss: 0.4"), ("home:", "hme:"), ("max_count: 2", "colour: red")]), @r#"
    t.yaml:4:68: error: unknown key `masss`
      help: did you mean `mass`?
    t.yaml:12:9: error: unknown key `hme`
      help: did you mean `home`?
    t.yaml:14:72: error: unknown key `colour`
      help: use `form`, `directions`, `offsets`, `grip_yaws_deg`, `length`, `speed`, `max_count`, `tool_changes` or `lift`
    "#);
}

#[test]
fn tilted_objects_are_imported_upright() {
    assert_snapshot!(task(&[("mass: 0.4", "mass: 0.4, pitch_deg: 90")]), @r#"
    t.yaml:4:79: error: unknown key `pitch_deg`
      help: all bodies stand upright and rotate by `yaw_deg` only: write a lying box with other sizes; a lying can would roll, which is not modelled
    "#);
}

#[test]
fn missing_and_doubled_keys() {
    assert_snapshot!(task(&[("mass: 0.5\n      friction: 0.3", "mass: 0.5\n      mass: 0.6"), (", tolerance: 0.05", "")]), @r#"
    t.yaml:5:7: error: missing key `friction`
      help: Friction value; the coefficient of a pair is the mean of the two values.
    t.yaml:8:7: error: key `mass` is given twice
      help: keep one of the two
    t.yaml:15:31: error: `position` needs a `tolerance`
      help: add `tolerance: 0.02`, in metres
    "#);
}

#[test]
fn numbers_with_leading_zeros_are_written_without_them() {
    for (written, advice) in [
        ("08", "write 8,"),
        ("-09", "write -9,"),
        ("0091", "write 91,"),
        ("\"8\"", "remove the quotes"),
    ] {
        let found = task(&[("mass: 0.5", &format!("mass: {written}"))]);
        assert!(found.contains(advice), "{written}: {found}");
    }
}

#[test]
fn wrong_kinds_of_values() {
    assert_snapshot!(task(&[("radius: 0.05", "radius: 5cm"), ("mass: 0.5", "mass: \"0.5\""), ("[0.7, -0.1]", "[0.7]"), ("max_count: 2", "max_count: 1.5"), ("tools: [stick, l-hook]", "tools: every"), ("name: box", "name: 7"), ("directions: principal", "directions: {}")]), @r#"
    t.yaml:4:46: error: expected a size in metres from 0.001 to 10, found the text "5cm"
      help: write the bare number, without a unit; lengths are in metres: 50 mm is 0.05
    t.yaml:5:13: error: expected a name, found the number 7
      help: write it in quotes
    t.yaml:7:13: error: expected a mass in kg from 0.001 to 1000, found the text "0.5"
      help: remove the quotes
    t.yaml:9:17: error: expected a list of 2 numbers, found a list of 1 item
    t.yaml:13:8: error: expected `all` or a list of 1 to 64 tools, found the text "every"
      help: write a list: [every]
    t.yaml:14:36: error: expected `principal`, a number of directions from 1 to 64 or a list of 1 to 64 angles in degrees, found an empty map
    t.yaml:14:76: error: expected a number of pushes from 1 to 64, found the number 1.5
      help: write a whole number
    "#);
}

#[test]
fn numbers_out_of_range() {
    assert_snapshot!(task(&[("radius: 0.05", "radius: -0.05"), ("mass: 0.4", "mass: .nan"), ("friction: 0.4", "friction: 0"), ("[0.08, 0.1, 0.06]", "[80, 100, .inf]"), ("speed: 0.1", "speed: 10"), ("max_count: 2", "max_count: 99")]), @r#"
    t.yaml:4:46: error: expected a size in metres from 0.001 to 10, found the number -0.05
      help: lengths are in metres: 50 mm is 0.05
    t.yaml:4:75: error: expected a mass in kg from 0.001 to 1000, found the number NaN
      help: masses are in kilograms: 250 g is 0.25
    t.yaml:4:91: error: expected a friction value from 0.05 to 2, found the number 0
      help: wood on wood is about 0.4, rubber about 0.8; without friction no object comes to rest
    t.yaml:6:31: error: expected a size in metres from 0.001 to 10, found the number 80
      help: lengths are in metres: 50 mm is 0.05
    t.yaml:6:35: error: expected a size in metres from 0.001 to 10, found the number 100
      help: lengths are in metres: 50 mm is 0.05
    t.yaml:6:40: error: expected a size in metres from 0.001 to 10, found the number inf
      help: lengths are in metres: 50 mm is 0.05
    t.yaml:14:67: error: expected a speed in m/s from 0.01 to 1, found the number 10
      help: 10 cm/s is 0.10
    t.yaml:14:82: error: expected a number of pushes from 1 to 64, found the number 99
      help: three pushes move an object around a corner
    "#);
}

#[test]
fn numbers_that_no_computer_holds() {
    assert_snapshot!(task(&[("radius: 0.05", "radius: -1e999"), ("mass: 0.5", "mass: 1e999"), ("max_count: 2", "max_count: nan")]), @r#"
    t.yaml:4:46: error: expected a size in metres from 0.001 to 10, found a number beyond 1e308
      help: lengths are in metres: 50 mm is 0.05
    t.yaml:7:13: error: expected a mass in kg from 0.001 to 1000, found a number beyond 1e308
      help: masses are in kilograms: 250 g is 0.25
    t.yaml:14:83: error: expected a number of pushes from 1 to 64, found the text "nan"
      help: three pushes move an object around a corner
    "#);
    let file = r#"{"schema_version": 1, "kind": "plan", "model": 1e999}"#;
    assert_snapshot!(PlanFile::parse(file, "t").unwrap_err(), @r#"
    t:1:52: error: not valid JSON: number out of range
      help: write a number that is smaller than 1e308
    "#);
}

#[test]
fn empty_values_and_lists() {
    assert_snapshot!(task(&[("[stick, l-hook]", "[]"), ("mass: 0.5", "mass:"), ("{cylinder: {radius: 0.05, height: 0.10}}", "{}")]), @r#"
    t.yaml:4:26: error: expected a map with one key, `cylinder`, `cuboid` or `prism`, found an empty map
    t.yaml:7:12: error: expected a mass in kg from 0.001 to 1000, found nothing
      help: remove the key, or write its value after it
    t.yaml:13:8: error: expected a list of 1 to 64 tools, found an empty list
    "#);
}

#[test]
fn bodies_that_overlap_or_share_a_name() {
    assert_snapshot!(task(&[("[0.7, -0.1]", "[0.63, 0.1]"), ("name: box", "name: can"), ("[0.9, 0]", "[0.52, 0]")]), @r#"
    t.yaml:5:13: error: two bodies are called `can`
      help: rename one; plans and messages refer to names
    t.yaml:9:17: error: `can` overlaps `can`
      help: move one of them; bodies may touch but not overlap
    t.yaml:11:54: error: `wall` overlaps `can`
      help: move one of them; bodies may touch but not overlap
    "#);
}

#[test]
fn faults_in_one_place_do_not_hide_those_in_another() {
    assert_snapshot!(task(&[("mass: 0.4", "mass: heavy"), ("[0.7, -0.1]", "[0.6, 0.1]"), ("object: can", "object: cna"), ("max: 0.5", "max: 0.05")]), @r#"
    t.yaml:4:74: error: expected a mass in kg from 0.001 to 1000, found the text "heavy"
      help: write the bare number, without a unit; masses are in kilograms: 250 g is 0.25
    t.yaml:9:17: error: `box` overlaps `can`
      help: move one of them; bodies may touch but not overlap
    t.yaml:12:32: error: the smallest reach, 0.1, is not below the largest, 0.05
      help: swap them, or widen the reach
    t.yaml:15:16: error: no object is called `cna`
      help: did you mean `can`?
    "#);
}

#[test]
fn goals_that_cannot_be_meant() {
    assert_snapshot!(task(&[("object: can", "object: wall"), ("tolerance: 0.05", "tolerance: 0.05, heading_tolerance_deg: 5")]), @r#"
    t.yaml:15:16: error: `wall` is an obstacle, which is fixed to the table
      help: name an object; only objects can be pushed
    t.yaml:15:85: error: a heading tolerance without a heading
      help: add `heading_deg`, or remove it
    "#);
}

#[test]
fn a_heading_for_a_cylinder() {
    assert_snapshot!(task(&[("tolerance: 0.05", "tolerance: 0.05, heading_deg: 90")]), @r#"
    t.yaml:15:74: error: a cylinder looks the same at every heading, so it cannot have a heading goal
      help: remove `heading_deg`, or make the object a cuboid
    "#);
}

#[test]
fn supports_that_do_not_carry() {
    let standing = |support: &str| ("mass: 0.4, ", format!("mass: 0.4, support: {support}, "));
    let (old, aside) = standing("{points: [[0.01, 0], [0.03, 0.01], [0.03, -0.01]]}");
    assert_snapshot!(task(&[(old, &aside)]), @r#"
    t.yaml:4:88: error: the object would topple: its centre is not inside the polygon of these points
      help: the points are in the object's own frame, whose origin [0, 0] is its centre
    "#);
    let (old, wrong) = standing("{spread: 1.5}");
    assert_snapshot!(task(&[(old, &wrong)]), @r#"
    t.yaml:4:97: error: expected a share from 0.1 to 1, found the number 1.5
      help: 1 is the corners, or the rim; even pressure is like 0.5 to 0.7
    "#);
    for support in
        ["even", "corners", "{spread: 0.6}", "{points: [[0, 1e-2], [1e-2, 0], [-0.02, -0.02]]}"]
    {
        let (old, sound) = standing(support);
        let read = Task::parse(&spoiled(TASK, &[(old, &sound)]), "t.yaml").unwrap();
        let feet = read.scene.objects[0].feet();
        assert!((feet.load.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{support}");
    }
}

#[test]
fn a_goal_inside_an_obstacle() {
    let at = |x: &str| ("[0.35, 0.1], tolerance: 0.05", format!("[{x}, 0.1], tolerance: 0.03"));
    let (old, inside) = at("0.88");
    assert_snapshot!(task(&[(old, &inside)]), @r#"
    t.yaml:15:31: error: at the goal `can` would overlap `wall`
      help: move the goal or the obstacle, or allow a larger tolerance
    "#);
    // With a gap of 3.5 cm to the wall, the can fits at a centre distance of 6.5 cm.
    let (old, beside) = at("0.855");
    Task::parse(&spoiled(TASK, &[(old, &beside)]), "t.yaml").unwrap();
}

#[test]
fn an_unreachable_home() {
    assert_snapshot!(task(&[("home: [0.2, 0]", "home: [0.6, 0.3]")]), @r#"
    t.yaml:12:15: error: home is 0.671 m from the base, outside the reach of 0.1 to 0.5 m
      help: move home, or widen the reach; `base: none` states that there is no column
    "#);
}

#[test]
fn pushes_that_contradict_themselves() {
    assert_snapshot!(task(&[("form: placed, directions: principal", "form: chained, offsets: [0.01], directions: [180, 0, -180], lift: 0.2")]), @r#"
    t.yaml:14:34: error: chained pushes start from `home`, so they have no offsets
      help: remove `offsets`, or use `form: placed`
    t.yaml:14:63: error: this is the same as item 1 of `directions`
      help: remove one of the two
    t.yaml:14:76: error: at a lift of 0.2 m the tool passes above every object (0.1 m high)
      help: lower `lift` below the height of the objects
    "#);
}

#[test]
fn masses_too_far_apart() {
    assert_snapshot!(task(&[("mass: 0.4", "mass: 0.001"), ("mass: 0.5", "mass: 10")]), @r#"
    t.yaml:7:13: error: the heaviest object has 10000 times the mass of the lightest (0.001 kg); at most 1000 times can be simulated among 2 objects
      help: bring the masses closer together, or make the heaviest an obstacle
    "#);
}

#[test]
fn text_that_is_not_yaml() {
    assert_snapshot!(task(&[("robot: {home", "robot: {home: [")]), @r#"
    t.yaml:12:16: error: not valid YAML: did not find expected node content
      help: check indentation, brackets and quotes around this place
    "#);
}

#[test]
fn a_tag_has_no_meaning() {
    assert_snapshot!(task(&[("name: box", "name: !secret box")]), @r#"
    t.yaml:5:13: error: not valid YAML: scene.objects[1].name: tags such as `!name` are not supported here
      help: write the value without a tag
    "#);
}

#[test]
fn a_tool_in_two_pieces() {
    assert_snapshot!(tool(&[("[0.22, 0, 0]", "[0.25, 0, 0]")]), @r#"
    t.yaml:4:3: error: the parts form 2 separate pieces: handle | head
      help: move the pieces until they touch, or name a pair under `joints`
    "#);
}

#[test]
fn a_tool_full_of_faults() {
    assert_snapshot!(tool(&[("name: tee", "nmae: tee"), ("friction: 0.4", "friction: .inf"), ("name: head", "name: handle"), ("[0.22, 0, 0]", "[0.22, 0, 0.1]")]), @r#"
    t.yaml:1:1: error: unknown key `nmae`
      help: did you mean `name`?
    t.yaml:2:11: error: expected a friction value from 0.05 to 2, found the number inf
      help: wood on wood is about 0.4, rubber about 0.8; without friction no object comes to rest
    t.yaml:5:12: error: two parts are called `handle`
      help: rename one; plans and messages refer to names
    t.yaml:5:65: error: parts at different heights are not supported
      help: write 0; all parts stand side by side, and the push's `lift` is the height of their undersides
    "#);
}

#[test]
fn parts_with_two_solids_or_none() {
    assert_snapshot!(tool(&[("size: [0.2, 0.04, 0.05], ", ""), ("0.05], position: [0.22", "0.05], shape: {cylinder: {radius: 0.05, hight: 0.1}}, position: [0.22")]), @r#"
    t.yaml:4:5: error: this part has neither `size` nor `shape`
      help: add `size: [x, y, z]` in metres, or `shape: {cylinder: {radius: r, height: h}}`
    t.yaml:5:50: error: this part has both `size` and `shape`
      help: keep one of the two; `size` is short for a cuboid
    t.yaml:5:76: error: unknown key `hight`
      help: did you mean `height`?
    "#);
}

#[test]
fn joints_of_unknown_parts() {
    assert_snapshot!(tool(&[("friction: 0.4", "friction: 0.4\njoints: [[handle, haed], [head, head]]")]), @r#"
    t.yaml:3:19: error: no part is called `haed`
      help: did you mean `head`?
    t.yaml:3:26: error: a joint of a part with itself
      help: name two different parts
    "#);
}

#[test]
fn an_unknown_tool_has_its_place() {
    let library = ToolLibrary::embedded().unwrap();
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("t.yaml");
    std::fs::write(&path, spoiled(TASK, &[("l-hook", "lhook")])).unwrap();
    let faults = pushplan::asset::load_task(&path, &library).unwrap_err().to_string();
    let faults = faults.replace(&path.display().to_string(), "t.yaml");
    assert_snapshot!(faults, @r#"
    t.yaml:13:16: error: unknown tool `lhook`
      help: did you mean `hook`?
    "#);
}

#[test]
fn control_characters_are_shown_and_not_sent_to_the_terminal() {
    assert_snapshot!(task(&[("mass: 0.4", "\"ma\\e[31mss\": 0.4"), ("object: can", "object: \"can\\u202e\\nt.yaml:1:1: error: forged\"")]), @r#"
    t.yaml:4:7: error: missing key `mass`
      help: Mass in kg, including parts.
    t.yaml:4:68: error: unknown key `ma\u001b[31mss`
      help: use `name`, `shape`, `parts`, `mass`, `friction`, `support`, `may_fall`, `max_force`, `color`, `clearance`, `z`, `position` or `yaw_deg`
    t.yaml:15:16: error: expected a name, found the text "can\u202e\u000at.yaml:1:1: error: forged"
      help: use letters, digits, `-` and `_`, at most 64
    "#);
    let file = "a\u{9b}2J.yaml";
    assert_snapshot!(Tool::load(file).unwrap_err(), @r#"
    a\u009b2J.yaml: error: cannot read the file: No such file or directory (os error 2)
      help: check the path; it is relative to the current folder
    "#);
}

#[test]
fn a_missing_file() {
    let faults = Task::load("no/such/file.yaml").unwrap_err();
    assert_snapshot!(faults, @r#"
    no/such/file.yaml: error: cannot read the file: No such file or directory (os error 2)
      help: check the path; it is relative to the current folder
    "#);
}
