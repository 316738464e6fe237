//! Blade checks for tasks that allow lever-ups: a blade must exist and fit below the edge.

use crate::asset::diagnostic::did_you_mean;
use crate::asset::library::ToolLibrary;
use crate::asset::node::Node;
use crate::asset::strict::Ledger;
use crate::asset::take::name_of;
use crate::scene::Blade;

/// Reports tools without a blade, and blades that do not fit below the edge.
pub(super) fn check_blades(root: &Node, library: &ToolLibrary, ledger: &mut Ledger) {
    let wanted = root.get("goal").and_then(|goal| goal.get("object")?.text());
    let objects = root.get("scene").and_then(|scene| scene.get("objects"));
    let object = objects.map(Node::items).unwrap_or_default().iter();
    let clearance = object
        .filter(|object| wanted.is_some() && name_of(object) == wanted)
        .find_map(|object| object.get("clearance").or_else(|| object.get("z"))?.number());
    let fault = |blade: &Blade, clearance: f64| {
        let (name, mm) = (wanted.unwrap_or_default(), |metres: f64| 1e3 * metres);
        let blade = mm(blade.thickness);
        (blade > mm(clearance) + 1e-6).then(|| {
            let free = mm(clearance);
            format!("its blade is {blade} mm thick, but the clearance below `{name}` is {free} mm")
        })
    };
    let Some(tools) = root.get("tools") else { return };
    let levering = |name: &str| library.get(name).and_then(|tool| tool.blade());
    let pushing = |name: &str| library.get(name).is_some_and(|tool| tool.pushes());
    let named = || tools.items().iter().filter_map(Node::text);
    if root.get("pushes").is_some() && tools.text().is_none() {
        if named().any(pushing) && named().all(|name| levering(name).is_none()) {
            ledger.fault(
                tools,
                "none of these tools has a blade",
                "name a tool that levers as well",
            );
        } else if named().all(|name| levering(name).is_some()) {
            let message = "the task allows pushes, but none of these tools can push";
            ledger.fault(tools, message, "add a tool that can push, or remove `pushes`");
        }
    }
    for node in tools.items() {
        let Some(name) = node.text() else { continue };
        match (levering(name), clearance) {
            (None, _) if root.get("pushes").is_some() && pushing(name) => {}
            (None, _) => {
                let (message, advice) = unknown_blade(name, library);
                ledger.fault(node, message, advice);
            }
            (Some(blade), Some(clearance)) => {
                if let Some(message) = fault(&blade, clearance) {
                    let message = format!("`{name}` does not fit: {message}");
                    ledger.fault(node, message, "name a thinner tool, or check the clearance");
                }
            }
            (Some(_), None) => {}
        }
    }
    if let (Some(_), Some(clearance)) = (tools.text(), clearance)
        && let Some((name, thinnest)) = library
            .blades()
            .iter()
            .filter_map(|tool| Some((&tool.name, tool.blade()?)))
            .min_by(|(_, a), (_, b)| a.thickness.total_cmp(&b.thickness))
        && let Some(message) = fault(&thinnest, clearance)
    {
        let message = format!("no blade is thin enough; the thinnest is `{name}`: {message}");
        ledger.fault(tools, message, "add a thinner tool, or check the clearance");
    }
}

/// Returns message and advice for a tool of a levering task that is not in the library or has no
/// blade.
pub(super) fn unknown_blade(name: &str, library: &ToolLibrary) -> (String, String) {
    if library.get(name).is_some() {
        let message = format!("`{name}` has no blade, so it cannot lever");
        let known = library.blades().iter().map(|tool| format!("`{}`", tool.name));
        return (message, format!("use {}", known.collect::<Vec<_>>().join(" or ")));
    }
    let known = library.blades().iter().map(|tool| tool.name.as_str());
    (format!("unknown tool `{name}`"), did_you_mean(name, known))
}
