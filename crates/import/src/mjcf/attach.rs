//! Bodies of other models that a file attaches to its own.

use std::collections::HashMap;

use nalgebra::Isometry3;
use roxmltree::Node;

use crate::Language;
use crate::foreign::Files;
use crate::model::{Beyond, Model, Motion, Place};
use crate::read::parsed;
use crate::xml::Source;
use pushplan::asset::Fault;

/// Maximum number of bodies of a model, including attached bodies.
const MOST: usize = 5000;

/// Models that a file names, or their faults.
#[derive(Default)]
pub(super) struct Models(HashMap<String, Result<Model, Vec<Fault>>>);

impl Models {
    /// Reads the file named by a `model` element; its faults are reported where it is attached.
    pub fn add<'a>(&mut self, source: &mut Source<'a>, node: Node<'a, 'a>, files: &Files) {
        let Some(file) = node.attribute("file") else {
            source.fault(node, "this model has no `file`", "add its `file`");
            return;
        };
        let read = files.find("", file).and_then(|path| Ok((Files::bytes(&path)?, path)));
        let (bytes, path) = match read {
            Ok(found) => found,
            Err(refused) => return source.fault(node, refused.message, refused.advice),
        };
        let Some(inner) = files.within(&path) else {
            let message = "these models attach each other, or are far too many";
            return source.fault(node, message, "break the cycle");
        };
        let Ok(text) = String::from_utf8(bytes) else {
            let message = format!("{file} is not UTF-8 text");
            return source.fault(node, message, "is this the right file?");
        };
        let shown = path.display().to_string();
        let found = parsed(&text, &shown, &inner, source.ledger.is_strict());
        let found = found.map(|(mut model, _)| {
            let first = source.ledger.more_files(&model.files);
            let moved = |place: &mut Place| place.file += first;
            model.bodies.iter_mut().for_each(|body| {
                moved(&mut body.place);
                body.solids.iter_mut().for_each(|solid| moved(&mut solid.place));
            });
            model.beyond.iter_mut().for_each(|beyond| moved(&mut beyond.place));
            model.excluded.iter_mut().for_each(|(place, _)| moved(place));
            model
        });
        let name = node.attribute("name").map(str::to_owned);
        let name = name.or_else(|| found.as_ref().ok().map(|model| model.name.clone()));
        self.0.insert(name.unwrap_or_default(), found.map_err(|faults| faults.0));
    }

    /// Copies the bodies named by an `attach` element into `model`, below its body `onto` and at
    /// `pose`.
    pub fn attach<'a>(
        &self,
        source: &mut Source<'a>,
        node: Node<'a, 'a>,
        (onto, pose): (usize, &Isometry3<f64>),
        model: &mut Model,
    ) {
        source.judge(Language::Mjcf, "attach", node, |name| node.attribute_node(name));
        let named = node.attribute("model").unwrap_or_default();
        let other = match self.0.get(named) {
            Some(Ok(other)) => other,
            Some(Err(faults)) => return source.ledger.take(faults),
            None => {
                let message = format!("there is no model `{named}`");
                return source.fault(node, message, "use a model defined under <asset>");
            }
        };
        let top = match node.attribute("body") {
            None => 0,
            Some(name) => match other.bodies.iter().position(|body| body.name == name) {
                Some(top) => top,
                None => {
                    let message = format!("the model `{named}` has no body `{name}`");
                    return source.fault(node, message, "correct the name of the body");
                }
            },
        };
        let below = other.below(top);
        if model.bodies.len() + below.len() > MOST {
            let message = format!("with these bodies the model has more than {MOST}");
            return source.fault(node, message, "attach fewer bodies");
        }
        let prefix = node.attribute("prefix").unwrap_or_default();
        // The body keeps its pose relative to its former parent.
        let there = other.bodies[top]
            .parent
            .map_or_else(Isometry3::identity, |parent| other.bodies[parent].pose);
        let moved = pose * there.inverse();
        source.ledger.note_all(&other.notes);
        source.ledger.note_all(&other.bodies[0].notes);
        let mut bodies = HashMap::new();
        let mut solids = Vec::new();
        for index in below {
            let mut body = other.bodies[index].clone();
            for solid in &mut body.solids {
                solid.pose = moved * solid.pose;
                solids.push(solid.name.clone());
                if !solid.name.is_empty() {
                    solid.name.insert_str(0, prefix);
                }
            }
            if index == 0 {
                model.bodies[onto].solids.extend(body.solids);
                bodies.insert(index, onto);
                continue;
            }
            body.parent =
                Some(bodies.get(&body.parent.unwrap_or_default()).copied().unwrap_or(onto));
            body.name.insert_str(0, prefix);
            body.pose = moved * body.pose;
            body.motion = turned(body.motion, &moved);
            if let Some((_, middle, _)) = &mut body.inertial {
                *middle = moved * *middle;
            }
            if let Some((_, middle)) = &mut body.weighs {
                *middle = moved * *middle;
            }
            bodies.insert(index, model.bodies.len());
            model.bodies.push(body);
        }
        let prefixed = |names: &[String; 2]| names.clone().map(|name| format!("{prefix}{name}"));
        for (names, friction) in &other.pairs {
            if names.iter().all(|name| solids.contains(name)) {
                model.pairs.push((prefixed(names), *friction));
            }
        }
        for (place, names) in &other.excluded {
            let is_here =
                |name: &String| bodies.keys().any(|index| other.bodies[*index].name == *name);
            if names.iter().all(is_here) {
                model.excluded.push((*place, prefixed(names)));
            }
        }
        let here = |body: &usize| bodies.get(body).copied();
        model.joints.extend(
            other
                .joints
                .iter()
                .filter_map(|(name, body)| Some((format!("{prefix}{name}"), here(body)?))),
        );
        for beyond in &other.beyond {
            let named = beyond.bodies.as_ref().map(|on| on.iter().filter_map(here).collect());
            // What acts only on bodies that are not attached has no effect.
            if named.as_ref().is_none_or(|on: &Vec<usize>| !on.is_empty()) {
                model.beyond.push(Beyond { bodies: named, ..beyond.clone() });
            }
        }
    }
}

fn turned(motion: Motion, moved: &Isometry3<f64>) -> Motion {
    match motion {
        Motion::Hinge { axis, at, limits } => {
            Motion::Hinge { axis: moved * axis, at: moved * at, limits }
        }
        Motion::Slide { axis, limits } => Motion::Slide { axis: moved * axis, limits },
        Motion::Several(all) => {
            Motion::Several(all.into_iter().map(|motion| turned(motion, moved)).collect())
        }
        other => other,
    }
}
