//! Tests of `schema`.

use super::super::text::is_in_names;
use super::*;

#[test]
fn the_pattern_of_names_leaves_out_no_name() {
    let left_out = |c: char| NOT_IN_NAMES.iter().any(|(from, to)| (*from..=*to).contains(&c));
    for c in (0..=0xffff).filter_map(char::from_u32) {
        let allowed = is_in_names(c);
        assert!(!(allowed && left_out(c)), "{c:?}");
        assert!(allowed || left_out(c) || c > '\u{ff}', "{c:?}");
    }
    // Only escapes that every regex engine supports.
    let pattern = name_pattern();
    assert!(pattern.starts_with(r"^[^\u0000-\u002c\u002e-\u002f") && pattern.ends_with("]+$"));
    let escapes = pattern.split('\\').skip(1);
    assert!(escapes.map(|escape| escape.chars().next()).all(|kind| kind == Some('u')));
}

#[test]
fn names_alone_have_a_pattern() {
    let schemas = [
        tool_schema(),
        task_schema(),
        plan_schema(),
        trajectory_schema(),
        recording_schema(),
        world_schema(),
    ];
    for schema in schemas {
        let text = schema.to_string();
        let name = json!(name_pattern()).to_string();
        assert_eq!(text.matches("\"pattern\":").count(), text.matches(&name).count());
        assert!(!text.contains("\\p{"));
    }
}

#[test]
fn schemas_describe_every_key() {
    let saved = [plan_schema(), trajectory_schema(), recording_schema(), world_schema()];
    for schema in [tool_schema(), task_schema()].into_iter().chain(saved) {
        let properties = schema["properties"].as_object().unwrap();
        assert!(!properties.is_empty());
        assert!(properties.values().all(|p| p["description"].is_string()));
        assert_eq!(schema["additionalProperties"], json!(false));
    }
    assert_eq!(
        task_schema()["properties"]["scene"]["properties"]["objects"]["items"]["properties"]["mass"]
            ["minimum"],
        json!(0.001)
    );
}
