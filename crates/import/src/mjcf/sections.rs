//! Sections of a file.

use std::collections::HashSet;

use roxmltree::Node;

use crate::Language;
use crate::foreign::Files;
use crate::model::{Beyond, Body, Model};
use crate::xml::{Source, elements};
use pushplan::scene::GRAVITY;

use super::attach::Models;
use super::bodies::{BODIES, world};
use super::compiler::Compiler;
use super::contacts::pairs;
use super::defaults::Defaults;
use super::equality::equality;
use super::geoms::Context;
use super::meshes::Meshes;

/// Sections that do not affect the result of pushes.
const HARMLESS: [&str; 4] = ["visual", "statistic", "size", "sensor"];

/// Sections that move or hold bodies in ways that pushplan cannot express.
const BEYOND: [&str; 4] = ["actuator", "tendon", "deformable", "extension"];

/// Reads a `mujoco` element; returns `None` with faults if it cannot be read.
pub(crate) fn model<'a>(
    source: &mut Source<'a>,
    root: Node<'a, 'a>,
    files: &'a Files,
) -> Option<Model> {
    let name = root.attribute("model").unwrap_or_default().to_owned();
    let mut model =
        Model { name, bodies: vec![Body::world()], larger_friction: true, ..Model::default() };
    let mut context = Context {
        compiler: Compiler::default(),
        defaults: Defaults::default(),
        meshes: Meshes::of(files),
        models: Models::default(),
        paired: HashSet::new(),
        equality: true,
    };
    // Sections that others depend on are read first, regardless of their order in the file.
    for section in elements(root) {
        match section.tag_name().name() {
            "compiler" => context.compiler.read(source, section),
            "default" => context.defaults.read(source, section, None),
            "option" => {
                let flags = elements(section).filter(|node| node.has_tag_name("flag"));
                let off = flags.filter(|flag| flag.attribute("equality") == Some("disable"));
                context.equality &= off.count() == 0;
            }
            "asset" => {
                meshes(section, &mut context);
                for model in elements(section).filter(|asset| asset.has_tag_name("model")) {
                    context.models.add(source, model, files);
                }
            }
            "contact" => {
                let ends = elements(section).filter(|pair| pair.has_tag_name("pair"));
                let names = ends.flat_map(|pair| ["geom1", "geom2"].map(|end| pair.attribute(end)));
                context.paired.extend(names.flatten());
            }
            // Detects an exported arm early, because MuJoCo writes this section last.
            "custom" => custom(source, section, &mut model),
            _ => {}
        }
    }
    source.judge(Language::Mjcf, "mujoco", root, |name| root.attribute_node(name));
    // Joints that equality constraints and actuators name must be known.
    let late = |tag: &str| tag == "equality" || tag == "actuator";
    let (last, first): (Vec<_>, Vec<_>) =
        elements(root).partition(|section| late(section.tag_name().name()));
    for section in first.into_iter().chain(last) {
        match section.tag_name().name() {
            "compiler" | "default" | "asset" | "custom" => {}
            "equality" => equality(source, &context, section, &mut model),
            "worldbody" => world(source, &context, section, &mut model),
            "contact" => pairs(source, &context, section, &mut model),
            "option" => option(source, section),
            "keyframe" => {
                for key in elements(section) {
                    source.judge(Language::Mjcf, "key", key, |name| key.attribute_node(name));
                }
            }
            tag if HARMLESS.contains(&tag) => {}
            tag if BEYOND.contains(&tag) => {
                let of_arm = model.ours && tag == "actuator";
                if elements(section).next().is_some() && !of_arm {
                    let place = source.place(section);
                    let joint = |node| model.joint(Node::attribute(&node, "joint")?);
                    let bodies = elements(section).map(joint).collect();
                    model.beyond.push(Beyond { place, what: format!("<{tag}>"), bodies });
                }
            }
            tag => source.fault(section, format!("<{tag}> is not supported"), BODIES),
        }
    }
    Some(model)
}

fn meshes<'a>(section: Node<'a, 'a>, context: &mut Context<'a>) {
    for mesh in elements(section).filter(|asset| asset.has_tag_name("mesh")) {
        // A mesh without a name has the stem of its file as name.
        let stem = || std::path::Path::new(mesh.attribute("file")?).file_stem()?.to_str();
        if let Some(name) = mesh.attribute("name").or_else(stem) {
            context.meshes.add(name, mesh);
        }
    }
}

/// Reports options that change the motion of bodies.
fn option<'a>(source: &mut Source<'a>, option: Node<'a, 'a>) {
    gravity(source, option);
    source.judge(Language::Mjcf, "option", option, |name| option.attribute_node(name));
    for flag in elements(option).filter(|node| node.has_tag_name("flag")) {
        source.judge(Language::Mjcf, "flag", flag, |name| flag.attribute_node(name));
    }
}

/// Reports gravity other than on a level table on earth.
fn gravity<'a>(source: &mut Source<'a>, option: Node<'a, 'a>) {
    let Some(stated) = option.attribute_node("gravity") else { return };
    let Some([x, y, z]) = source.numbers(stated) else { return };
    if x.hypot(y) > 1e-3 * GRAVITY || (z + GRAVITY).abs() > 0.02 * GRAVITY {
        let message =
            format!("gravity is {x} {y} {z} m/s^2, but pushplan's tables are level and on earth");
        let none = x.hypot(y).hypot(z) < 1e-3 * GRAVITY;
        let advice = match none {
            true => "write `0 0 -9.81`; without weight there is no friction",
            false => "rotate the scene, so that gravity is `0 0 -9.81`",
        };
        source.fault_of(stated, message, advice);
    }
}

/// Reads data written by `pushplan export`; goals keep only positions and headings.
fn custom<'a>(source: &mut Source<'a>, section: Node<'a, 'a>, model: &mut Model) {
    for text in elements(section).filter(|node| node.has_tag_name("text")) {
        let name = text.attribute("name").unwrap_or_default();
        if let (Some(body), Some(words)) = (name.strip_prefix("words of "), text.attribute("data"))
        {
            let note = format!("the goal of `{body}` is ignored: \"{words}\" cannot be imported");
            source.ledger.note(source.place(text), note);
        }
    }
    for numeric in elements(section).filter(|node| node.has_tag_name("numeric")) {
        let name = numeric.attribute("name").unwrap_or_default();
        model.ours |= name == "push 1";
        let goal = name.strip_prefix("goal of ");
        if let (Some(body), Some(data)) = (goal, numeric.attribute_node("data"))
            && let Some(numbers) = source.list(data)
        {
            model.goals.push((body.to_owned(), numbers));
        }
    }
}
