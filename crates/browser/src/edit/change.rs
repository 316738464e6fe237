//! Changes, additions and removals of values in place.

use std::ops::Range;

use serde_yaml::Value as Yaml;

use pushplan::asset::{Content, Node, Source};

use super::apply::Step;
use super::flow::written;
use super::place::{is_flow, line_end, line_start, span, start};
use super::tree;

/// Returns the text with `value` at the end of `path`, or without the entry there. Returns `None`
/// where the change is not known to be possible. The caller must parse and check the result.
pub fn at_its_place(
    source: Source,
    root: &Node,
    path: &[Step],
    value: Option<&Yaml>,
) -> Option<String> {
    let text = source.text;
    let (mut node, mut flow) = (root, false);
    let mut parent = None;
    for (depth, step) in path.iter().enumerate() {
        let Some(next) = inner(node, step) else {
            let value = tree::wrapped(value?, &path[depth + 1..])?;
            let (at, new) = addition(source, node, flow, step, &value)?;
            return Some(format!("{}{new}{}", &text[..at], &text[at..]));
        };
        parent = Some(node);
        // Within brackets there are only brackets.
        flow = flow || is_flow(text, start(source, node)?);
        node = next;
    }
    match value {
        Some(value) => {
            let mut found = Vec::new();
            replacements(source, node, flow, value, &mut found)?;
            // Backwards, so that earlier places remain valid.
            found.sort_by_key(|(place, _)| std::cmp::Reverse(place.start));
            let mut text = text.to_owned();
            for (place, new) in found {
                text.replace_range(place, &new);
            }
            Some(text)
        }
        None => {
            let place = removed(source, parent?, path.last()?, flow)?;
            Some(format!("{}{}", &text[..place.start], &text[place.end..]))
        }
    }
}

fn inner<'a>(node: &'a Node, step: &Step) -> Option<&'a Node> {
    match step {
        Step::Key(key) => node.get(key),
        Step::Item(index) => node.items().get(*index),
    }
}

/// Collects the smallest replacements that write `value` at `node`.
fn replacements(
    source: Source,
    node: &Node,
    flow: bool,
    value: &Yaml,
    found: &mut Vec<(Range<usize>, String)>,
) -> Option<()> {
    if tree::same(&tree::of(node), value) {
        return Some(());
    }
    if let (Content::List(items), Yaml::Sequence(values)) = (&node.content, value)
        && items.len() == values.len()
    {
        let flow = flow || is_flow(source.text, start(source, node)?);
        let mut pairs = items.iter().zip(values);
        return pairs.try_for_each(|(node, value)| replacements(source, node, flow, value, found));
    }
    found.push((span(source, node, flow)?, written(value)));
    Some(())
}

/// Returns the position and the text that add `value` to a map or a list.
fn addition(
    source: Source,
    node: &Node,
    flow: bool,
    step: &Step,
    value: &Yaml,
) -> Option<(usize, String)> {
    let (text, place) = (source.text, span(source, node, flow)?);
    let (new, empty) = match (step, &node.content) {
        (Step::Key(key), Content::Map(pairs)) => {
            (format!("{}: {}", written(&key.as_str().into()), written(value)), pairs.is_empty())
        }
        (Step::Item(_), Content::List(items)) if is_flow(text, place.start) => {
            (written(value), items.is_empty())
        }
        (Step::Item(_), Content::List(items)) => {
            (format!("- {}", written(value)), items.is_empty())
        }
        _ => return None,
    };
    if is_flow(text, place.start) {
        let inside = text[place.start + 1..place.end - 1].trim_end();
        let at = place.start + 1 + inside.len();
        return Some((at, if empty { new } else { format!(", {new}") }));
    }
    let column = text[line_start(text, place.start)..place.start].chars().count();
    Some((place.end, format!("\n{}{new}", " ".repeat(column))))
}

/// Returns the range removed with the value at `step`: its key, and the comma or the lines around
/// it.
fn removed(source: Source, parent: &Node, step: &Step, flow: bool) -> Option<Range<usize>> {
    let text = source.text;
    let (index, last, first, value) = match (step, &parent.content) {
        (Step::Key(key), Content::Map(pairs)) => {
            let index = pairs.iter().position(|(own, _)| own.text() == Some(key))?;
            (index, pairs.len() - 1, &pairs[index].0, &pairs[index].1)
        }
        (Step::Item(index), Content::List(items)) => {
            (*index, items.len() - 1, items.get(*index)?, items.get(*index)?)
        }
        _ => return None,
    };
    let (begin, end) = (start(source, first)?, span(source, value, flow)?.end);
    if !is_flow(text, start(source, parent)?) {
        // The line of a key, or of a dash.
        return Some(line_start(text, begin)..line_end(text, end));
    }
    let spaces = |at: usize| text[at..].len() - text[at..].trim_start().len();
    if index < last {
        let comma = end + spaces(end);
        return text[comma..].starts_with(',').then(|| begin..comma + 1 + spaces(comma + 1));
    }
    match text[..begin].trim_end() {
        before if index > 0 && before.ends_with(',') => Some(before.len() - 1..end),
        _ if index == 0 => Some(begin..end),
        _ => None,
    }
}
