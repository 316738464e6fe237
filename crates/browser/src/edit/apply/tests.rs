//! Texts before and after edits.

use super::*;

const TEXT: &str = "\
# A comment stays.
description: Pull, then push  # and so does this
scene:
  objects:
    - {name: can, mass: 0.40, position: [0.62, 0.10]}  # the can
    - name: box
      position: [0.5, 0.0]
    # before the last
    - {name: ä, position: [1, 2]}
robot: {reach: {max: 0.5}}
tools: [stick, hook]
goal:
- {object: can}
";

fn path(words: &str) -> Vec<Step> {
    let step = |word: &str| word.parse().map_or(Step::Key(word.to_owned()), Step::Item);
    words.split('.').map(step).collect()
}

fn changed(words: &str, value: Option<Json>) -> String {
    edit(TEXT, "t", &[Edit { path: path(words), value }]).unwrap()
}

/// Returns the changed lines, marked `-` and `+`.
fn lines(words: &str, value: Option<Json>) -> String {
    let new = changed(words, value);
    let (old, new): (Vec<&str>, Vec<&str>) = (TEXT.lines().collect(), new.lines().collect());
    let ahead = old.iter().zip(&new).take_while(|(a, b)| a == b).count();
    let most = old.len().min(new.len()) - ahead;
    let behind =
        old.iter().rev().zip(new.iter().rev()).take(most).take_while(|(a, b)| a == b).count();
    let marked = |sign: &str, lines: &[&str]| {
        let lines = &lines[ahead..lines.len() - behind];
        lines.iter().map(|line| format!("{sign}{}\n", line.trim_end())).collect::<String>()
    };
    marked("-", &old) + &marked("+", &new)
}

#[test]
fn a_number_changes_and_nothing_else() {
    insta::assert_snapshot!(lines("scene.objects.0.position", Some(serde_json::json!([0.625, 0.1]))), @r"
    -    - {name: can, mass: 0.40, position: [0.62, 0.10]}  # the can
    +    - {name: can, mass: 0.40, position: [0.625, 0.10]}  # the can
    ");
    insta::assert_snapshot!(lines("scene.objects.2.position.1", Some(serde_json::json!(-0.5))), @r"
    -    - {name: ä, position: [1, 2]}
    +    - {name: ä, position: [1, -0.5]}
    ");
    insta::assert_snapshot!(lines("description", Some(serde_json::json!("Push: it"))), @r#"
    -description: Pull, then push  # and so does this
    +description: "Push: it"  # and so does this
    "#);
    assert_eq!(changed("scene.objects.0.mass", Some(serde_json::json!(0.4))), TEXT);
}

#[test]
fn keys_and_items_are_added() {
    let wall = serde_json::json!({"name": "wall", "size": [0.1, 0.02, 0.1]});
    insta::assert_snapshot!(lines("scene.obstacles.0", Some(wall.clone())), @"+  obstacles: [{name: wall, size: [0.1, 0.02, 0.1]}]");
    insta::assert_snapshot!(lines("scene.objects.3", Some(wall)), @"+    - {name: wall, size: [0.1, 0.02, 0.1]}");
    insta::assert_snapshot!(lines("scene.objects.1.yaw_deg", Some(serde_json::json!(30))), @"+      yaw_deg: 30");
    insta::assert_snapshot!(lines("robot.reach.min", Some(serde_json::json!(0.1))), @r"
    -robot: {reach: {max: 0.5}}
    +robot: {reach: {max: 0.5, min: 0.1}}
    ");
    insta::assert_snapshot!(lines("tools.2", Some(serde_json::json!("rake"))), @r"
    -tools: [stick, hook]
    +tools: [stick, hook, rake]
    ");
    insta::assert_snapshot!(lines("tools", Some(serde_json::json!("all"))), @r"
    -tools: [stick, hook]
    +tools: all
    ");
    insta::assert_snapshot!(lines("goal.1", Some(serde_json::json!({"object": "true"}))), @r#"
    +- {object: "true"}
    "#);
}

#[test]
fn keys_and_items_are_taken_away() {
    insta::assert_snapshot!(lines("scene.objects.1", None), @r"
    -    - name: box
    -      position: [0.5, 0.0]
    ");
    insta::assert_snapshot!(lines("scene.objects.0.mass", None), @r"
    -    - {name: can, mass: 0.40, position: [0.62, 0.10]}  # the can
    +    - {name: can, position: [0.62, 0.10]}  # the can
    ");
    insta::assert_snapshot!(lines("tools.1", None), @r"
    -tools: [stick, hook]
    +tools: [stick]
    ");
    insta::assert_snapshot!(lines("description", None), @"-description: Pull, then push  # and so does this");
}

#[test]
fn a_value_that_cannot_be_changed_in_place_is_rewritten() {
    let text = "a: &a [1, 2]\nb: *a\nc: one\n  two\n# end\n";
    let change = |words: &str, value: Json| {
        edit(text, "t", &[Edit { path: path(words), value: Some(value) }]).unwrap()
    };
    // An anchor and its alias: only the alias must change.
    assert_eq!(change("b.0", 5.into()), "a:\n- 1\n- 2\nb:\n- 5\n- 2\nc: one two\n");
    assert_eq!(change("c", "x".into()), "a:\n- 1\n- 2\nb:\n- 1\n- 2\nc: x\n");
    let nowhere = [Edit { path: path("a.7.b"), value: Some(1.into()) }];
    assert!(edit(text, "t", &nowhere).unwrap_err().to_string().contains("no value at `a.8.b`"));
}

#[test]
fn shipped_tasks_keep_every_other_letter() {
    for name in pushplan::Task::examples() {
        let text = pushplan::asset::example_text(name).unwrap();
        let place = path("scene.objects.0.position");
        let new =
            edit(text, "t", &[Edit { path: place, value: Some(serde_json::json!([7.125, 8.25])) }]);
        let new = new.unwrap();
        let differs = |(a, b): &(&str, &str)| a != b;
        assert_eq!(text.lines().count(), new.lines().count(), "{name}");
        assert_eq!(text.lines().zip(new.lines()).filter(differs).count(), 1, "{name}");
        assert!(new.contains("position: [7.125, 8.25]"), "{name}");
    }
}
