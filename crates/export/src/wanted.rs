//! The goals of a plan in MJCF, which `replay.py` judges by.

use pushplan::asset::PlanFile;
use pushplan::geometry::Pose;
use pushplan::{
    scene::{Body, Engine, Scene},
    task::{Demand, Fall, Gap},
};

use super::mjcf::object_name;
use super::strokes::numeric;
use super::xml::Xml;

/// What stands for a goal that asks for no place, metres.
const ANYWHERE: f64 = 1e6;

/// The goal, and what our own replay says.
pub(super) fn wanted(xml: &mut Xml, file: &PlanFile) {
    let scene = &file.task.scene;
    xml.comment(
        "x, y, tolerance; where it matters, heading, its tolerance, and the number of headings in \
         a turn that look alike.",
    );
    for goal in file.task.goals.iter() {
        let name = &scene.objects[goal.object].name;
        // MJCF has no infinity; no table is as large.
        let placed = goal.position().filter(|_| !goal.is_relation());
        let tolerance = placed.map_or(ANYWHERE, |_| goal.tolerance());
        let position = placed.unwrap_or_default();
        let mut wanted = vec![position.x, position.y, tolerance];
        let heading = goal.heading().into_iter();
        wanted.extend(heading.flat_map(|own| [own.heading, own.tolerance, own.symmetry as f64]));
        numeric(xml, &format!("goal of object/{name}"), &wanted);
        if let Some(middle) = goal.heading().and_then(|facing| facing.limit_middle) {
            xml.comment(
                "Headings are told from those a full turn away by being nearest to this one.",
            );
            numeric(xml, &format!("middle of object/{name}"), &[middle]);
        }
        goal.demands.iter().for_each(|demand| one(xml, scene, name, demand));
        if let Some(other) = goal.relative() {
            xml.comment("The body in whose frame all of this is.");
            let data = object_name(&scene.objects[other]);
            xml.leaf("text", &[("name", format!("frame of object/{name}")), ("data", data)]);
        }
    }
    for object in scene.objects.iter().filter(|object| object.may_fall) {
        numeric(xml, &format!("may fall of object/{}", object.name), &[1.0]);
    }
    if let Some(evidence) = file.verdict.as_ref().and_then(|v| v.nominal(Engine::Spatial)) {
        xml.comment("Where our own 3-D replay ends: x, y, heading.");
        for (object, pose) in scene.objects.iter().zip(&evidence.outcome.state.poses) {
            let values = [pose.position.x, pose.position.y, pose.heading];
            numeric(xml, &format!("3-D replay of object/{}", object.name), &values);
        }
    }
}

/// The numbers of a demand beyond position and heading.
fn one(xml: &mut Xml, scene: &Scene, name: &str, demand: &Demand) {
    match demand {
        Demand::Area(own) => {
            xml.comment("Where it may lie instead: the corners of a region, x, y, x, y and so on.");
            let corners = own.area.corners().into_iter().flat_map(|corner| [corner.x, corner.y]);
            numeric(xml, &format!("region of object/{name}"), &corners.collect::<Vec<_>>());
        }
        Demand::Gap(gap) => outlines(xml, scene, name, gap),
        Demand::Coverage(coverage) => {
            xml.comment(
                "The share of its own outline at the goal that it covers instead, and that outline in the \
                 body's frame: corners of convex polygons that share no area.",
            );
            numeric(xml, &format!("coverage of object/{name}"), &[coverage.share]);
            for (k, corners) in coverage.outline(&Pose::default()).iter().enumerate() {
                let corners: Vec<f64> = corners.iter().flat_map(|at| [at.x, at.y]).collect();
                numeric(xml, &format!("piece {} of object/{name}", k + 1), &corners);
            }
        }
        Demand::Fall(fall) => edges(xml, name, fall),
        _ => {}
    }
}

/// The edges over which an object falls.
fn edges(xml: &mut Xml, name: &str, fall: &Fall) {
    xml.comment(
        "Its centre of mass in its own frame, x and y, and the edges over which it is to fall: the way \
         out, x and y, and how far along that the edge is.",
    );
    let centre = fall.centre(&Pose::default());
    let edges = fall.edges().flat_map(|edge| {
        let out = edge.outwards();
        [out.x, out.y, fall.place(edge) + fall.by]
    });
    let numbers: Vec<f64> = [centre.x, centre.y].into_iter().chain(edges).collect();
    numeric(xml, &format!("fall of object/{name}"), &numbers);
    if let Some(span) = fall.between {
        xml.comment("Between which places along that edge, x or y.");
        numeric(xml, &format!("part of the edge of object/{name}"), &[span.low, span.high]);
    }
}

/// How far an object is to be from something else.
fn outlines(xml: &mut Xml, scene: &Scene, name: &str, gap: &Gap) {
    xml.comment(
        "The smallest and largest gap to something else, and the corners of all outlines of both, x, y, x, y \
         and so on, each in the frame of its body.",
    );
    numeric(xml, &format!("gap of object/{name}"), &[gap.min, gap.max.min(ANYWHERE)]);
    for (whose, areas) in ["own", "other"].into_iter().zip(gap.outlines()) {
        for (k, area) in areas.enumerate() {
            let corners = area.corners().into_iter().flat_map(|corner| [corner.x, corner.y]);
            let title = format!("{whose} outline {} of object/{name}", k + 1);
            numeric(xml, &title, &corners.collect::<Vec<_>>());
        }
    }
    if let Body::Object(other) = gap.to {
        let data = object_name(&scene.objects[other]);
        xml.leaf("text", &[("name", format!("other of object/{name}")), ("data", data)]);
    }
}
