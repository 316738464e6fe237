//! Objects, and the joints between them.

use nalgebra::Point3;

use crate::asset::Place;
use crate::geometry::{ConvexPolygon, Pose, Shape, Vector};
use crate::import::fault::Ledger;
use crate::import::model::{Body, Model, Motion, Outline, Solid, Weight};
use crate::scene::{Joint, JointKind, Object, Span};

use super::feet::support;
use super::groups::held_by;
use super::names::Names;
use super::upright::{Base, Upright, volume};
use super::wanted::Wanted;

/// A centre of mass nearer to the middle than this is in the middle, metres.
const OFF_CENTRE: f64 = 1e-6;

/// A mass this small is none, kg.
const NOTHING: f64 = 1e-9;

/// Differences from what pushplan assumes that are worth a note: a centre of mass above or below
/// the middle, as a share of the height, and a moment of inertia, as a share of itself.
const WORTH_A_NOTE: f64 = 0.1;

/// An object before it stands on a table.
pub(super) struct Draft<'a> {
    pub object: Object,
    pub place: Place,
    /// The body that it is of.
    pub body: usize,
    /// The freely movable or jointed body that this is fixed to.
    pub group: usize,
    /// What touches others.
    pub solid: &'a Solid,
    /// What touches the table, where the solid does not.
    pub feet: Vec<&'a Solid>,
    /// Height of the lowest point in the world, metres.
    pub low: f64,
}

/// Objects and joints of everything that hangs on the body `root`.
pub(super) fn drafts<'a>(
    model: &'a Model,
    root: usize,
    wanted: &Wanted,
    names: &mut Names,
    ledger: &mut Ledger,
) -> (Vec<Draft<'a>>, Vec<(usize, Motion)>) {
    let (mut found, mut hung) = (Vec::new(), Vec::new());
    let mut waiting = vec![root];
    while let Some(group) = waiting.pop() {
        let bodies = model.rigid(group);
        found.extend(of_group(model, group, &bodies, wanted, names, ledger));
        for body in &bodies {
            for child in model.children(*body).filter(|child| !bodies.contains(child)) {
                hung.push((child, model.bodies[child].motion.clone()));
                waiting.push(child);
            }
        }
    }
    (found, hung)
}

/// Objects of bodies that are fixed to each other.
fn of_group<'a>(
    model: &'a Model,
    group: usize,
    bodies: &[usize],
    wanted: &Wanted,
    names: &mut Names,
    ledger: &mut Ledger,
) -> Vec<Draft<'a>> {
    let touching = |body: &'a Body| body.solids.iter().filter(|solid| solid.touches);
    let is_foot = |solid: &&Solid| matches!(solid.outline, Outline::Sphere(_));
    let solids: Vec<(usize, &Solid)> = bodies
        .iter()
        .flat_map(|body| touching(&model.bodies[*body]).map(move |solid| (*body, solid)))
        .filter(|(_, solid)| !is_foot(solid))
        .collect();
    let (owner, place) = (&model.bodies[group], model.bodies[group].place);
    if solids.is_empty() {
        let ball = bodies.iter().flat_map(|body| touching(&model.bodies[*body])).next();
        if let Some(ball) = ball {
            Upright::of(ball, &format!("`{}`", owner.name), ledger);
            return Vec::new();
        }
        let message = format!("`{}` has nothing that touches", owner.name);
        ledger.fault(place, message, "give it a box, a cylinder or a prism that touches others");
        return Vec::new();
    }
    let mut found = Vec::new();
    for (body, solid) in &solids {
        let of = &model.bodies[*body];
        let alone = solids.iter().filter(|(other, _)| other == body).count() == 1;
        let name = match (alone, solid.name.is_empty()) {
            (true, _) => of.name.clone(),
            (false, false) => {
                format!("{}-{}", super::names::bare(&of.name), super::names::bare(&solid.name))
            }
            (false, true) => of.name.clone(),
        };
        let name = names.take(&name);
        if let Outline::Other(_) = solid.outline {
            // That it cannot be expressed matters more than its mass.
            Upright::of(solid, &format!("`{name}`"), ledger);
            continue;
        }
        // With a single solid it carries everything that is fixed to it.
        let (mass, centre, moment) = match (solids.len(), alone) {
            (1, _) => match together(model, bodies, ledger) {
                Some(found) => found,
                None => continue,
            },
            (_, true) => match of_body(of, ledger) {
                Some(found) => found,
                None => continue,
            },
            (_, false) if of.inertial.is_some() => {
                let message = format!("`{}` states one mass for several solids", of.name);
                let advice = "state masses of its solids, or make each solid a body of its own";
                ledger.fault(of.place, message, advice);
                return found;
            }
            (_, false) => match of_solid(solid, ledger) {
                Some(mass) => (mass, None, None),
                None => continue,
            },
        };
        if mass <= NOTHING {
            let message = format!("`{name}` has no mass");
            ledger.fault(of.place, message, "state its mass in kilograms (<inertial>)");
            continue;
        }
        let feet = if alone { touching(of).filter(is_foot).collect() } else { Vec::new() };
        let weight = (mass, centre, moment);
        let friction = solid.material.friction.unwrap_or(wanted.friction);
        let drafted = draft(&name, (solid, feet), weight, friction, ledger);
        found.extend(drafted.map(|(object, feet, low)| Draft {
            object,
            place: solid.place,
            body: *body,
            group,
            solid,
            feet,
            low,
        }));
    }
    for body in bodies.iter().map(|body| &model.bodies[*body]) {
        let bare = touching(body).all(|solid| is_foot(&solid));
        let feet = touching(body).find(is_foot);
        if solids.len() > 1
            && bare
            && of_body(body, ledger).is_some_and(|(mass, ..)| mass > NOTHING)
        {
            let message = format!("`{}` has a mass but no solid of its own", body.name);
            ledger.fault(body.place, message, "give its mass to the bodies that it is fixed to");
        }
        let several = touching(body).filter(|solid| !is_foot(solid)).count() != 1;
        if let Some(foot) = feet.filter(|_| several) {
            let message = format!("a sphere of `{}` is under none or several solids", body.name);
            let advice = "spheres are the points that a body with one solid stands on";
            ledger.fault(foot.place, message, advice);
        }
    }
    found
}

type Weighed = (f64, Option<Point3<f64>>, Option<f64>);

/// Mass, centre of mass and moment of inertia of one body.
fn of_body(body: &Body, ledger: &mut Ledger) -> Option<Weighed> {
    if let Some((mass, centre, moment)) = body.inertial {
        return Some((mass, Some(centre), moment));
    }
    let mut parts = Vec::new();
    for solid in &body.solids {
        if solid.material.weight == Weight::OfBody {
            let message = format!("`{}` states no mass", body.name);
            ledger.fault(body.place, message, "add <inertial> with its <mass>");
            return None;
        }
        parts.push((of_solid(solid, ledger)?, solid));
    }
    let mass: f64 = parts.iter().map(|(mass, _)| mass).sum();
    let heavy: Vec<_> = parts.iter().filter(|(mass, _)| *mass > 0.0).collect();
    // One solid has its weight in its own middle, which knows prisms, too.
    if let [_] | [] = heavy[..] {
        return Some((mass, None, None));
    }
    let moment = heavy.iter().map(|(mass, solid)| *mass * solid.pose.translation.vector);
    Some((mass, Some(Point3::from(moment.sum::<nalgebra::Vector3<f64>>() / mass)), None))
}

/// The same of bodies that are fixed to each other.
fn together(model: &Model, bodies: &[usize], ledger: &mut Ledger) -> Option<Weighed> {
    let mut weighed = Vec::new();
    for body in bodies.iter().map(|body| &model.bodies[*body]) {
        let (mass, centre, moment) = of_body(body, ledger)?;
        if mass > NOTHING {
            let middle = Point3::from(body.pose.translation.vector);
            weighed.push((mass, centre, middle, moment));
        }
    }
    match weighed[..] {
        [] => Some((0.0, None, None)),
        [(mass, centre, _, moment)] => Some((mass, centre, moment)),
        _ => {
            let mass: f64 = weighed.iter().map(|(mass, ..)| mass).sum();
            let parts = weighed
                .iter()
                .map(|(mass, centre, middle, _)| centre.unwrap_or(*middle).coords * *mass);
            Some((mass, Some(Point3::from(parts.sum::<nalgebra::Vector3<f64>>() / mass)), None))
        }
    }
}

/// What one solid weighs, kg.
fn of_solid(solid: &Solid, ledger: &mut Ledger) -> Option<f64> {
    let density = match solid.material.weight {
        Weight::Mass(mass) => return Some(mass),
        Weight::OfBody => return Some(0.0),
        Weight::Density(density) => density,
    };
    if density == 0.0 {
        return Some(0.0);
    }
    let volume = volume(solid);
    if volume.is_none() {
        let message = "what this solid weighs follows from a density, and its volume is not known";
        ledger.fault(solid.place, message, "state `mass`, or add <inertial> to its body");
    }
    volume.map(|volume| density * volume)
}

/// An object of a solid and what it stands on; gives its feet and its lowest point, too.
fn draft<'a>(
    name: &str,
    (solid, feet): (&'a Solid, Vec<&'a Solid>),
    (mass, centre, moment): Weighed,
    friction: f64,
    ledger: &mut Ledger,
) -> Option<(Object, Vec<&'a Solid>, f64)> {
    let upright = Upright::of(solid, &format!("`{name}`"), ledger)?;
    let radius = |foot: &Solid| match foot.outline {
        Outline::Sphere(radius) => radius,
        _ => 0.0,
    };
    let reach = |foot: &&Solid| foot.pose.translation.z - radius(foot);
    let low = feet.iter().map(reach).fold(upright.low, f64::min);
    if let Some(foot) = feet.iter().find(|foot| reach(foot) > low + 1e-6) {
        let message = format!("a sphere of `{name}` does not reach as low as it does");
        ledger.fault(foot.place, message, "spheres are the points that a body stands on");
        return None;
    }
    // An object on feet is as high as the feet and it together; any other keeps its digits.
    let height = if low < upright.low { upright.top() - low } else { upright.height };
    let middle = upright.middle();
    let seen = |point: Point3<f64>| upright.pose.local_point(Vector::new(point.x, point.y));
    let centre = centre.map(|centre| (seen(centre), centre.z));
    let off = centre.map_or(Vector::zeros(), |(centre, _)| centre - middle);
    let at = if off.norm() > OFF_CENTRE { middle + off } else { middle };
    let polygon = |corners: &[Vector], ledger: &mut Ledger| {
        let made = ConvexPolygon::balanced(corners, at);
        if let Err(error) = &made {
            let message = format!("`{name}` is not a prism that pushplan knows: {error}");
            ledger.fault(solid.place, message, "leave out corners that matter least");
        }
        made.ok().map(|base| Shape::Prism { base, height })
    };
    let shape = match &upright.base {
        Base::Rectangle([x, y]) if at == middle => Shape::Cuboid { size: [*x, *y, height] },
        Base::Rectangle([x, y]) => {
            let ends = [[-x, -y], [*x, -y], [*x, *y], [-x, *y]];
            polygon(&ends.map(|end| Vector::from(end) / 2.0), ledger)?
        }
        Base::Disc(radius) if at == middle => Shape::Cylinder { radius: *radius, height },
        Base::Disc(_) => {
            let off = 1e3 * off.norm();
            let message = format!("the centre of mass of `{name}` is {off:.1} mm off its axis");
            ledger.fault(solid.place, message, "make it a prism, which may be off balance");
            return None;
        }
        Base::Polygon(corners) => polygon(corners, ledger)?,
    };
    let footprint = shape.footprint();
    if let Some((_, z)) = centre {
        let above = z - (low + height / 2.0);
        if above.abs() > WORTH_A_NOTE * height {
            let side = if above > 0.0 { "above" } else { "below" };
            let by = 1e3 * above.abs();
            let note = format!(
                "the centre of mass of `{name}` is {by:.1} mm {side} the middle, where pushplan has it"
            );
            ledger.note(solid.place, note);
        }
    }
    if let Some(stated) = moment {
        let ours = mass * footprint.gyration_radius().powi(2);
        if (stated - ours).abs() > WORTH_A_NOTE * ours {
            let note = format!(
                "`{name}` states a moment of inertia about the vertical of {:.2} times that of an \
                 even solid, which pushplan takes",
                stated / ours
            );
            ledger.note(solid.place, note);
        }
    }
    let pose = Pose { position: upright.pose.point(at), heading: upright.pose.heading };
    let points = feet.iter().map(|foot| {
        let at = foot.pose.translation;
        pose.local_point(Vector::new(at.x, at.y))
    });
    let Some(support) = support(&points.collect::<Vec<_>>(), &footprint) else {
        let message = format!("`{name}` stands on {} spheres", feet.len());
        ledger.fault(solid.place, message, "three to eight points can be stated");
        return None;
    };
    let object = Object { support, mass, friction, pose, ..Object::new(name, shape) };
    Some((object, feet, low))
}

/// Joints: everything fixed together, then everything attached by other joints.
pub(super) fn joints(
    model: &Model,
    drafts: &[Draft<'_>],
    hung: &[(usize, Motion)],
    ledger: &mut Ledger,
) -> Vec<Joint> {
    let mut found = Vec::new();
    for (index, draft) in drafts.iter().enumerate() {
        let first = drafts[..index].iter().position(|other| other.group == draft.group);
        found.extend(first.map(|first| Joint::new([first, index], JointKind::Fixed)));
    }
    for (body, motion) in hung {
        let Body { name, place, parent, .. } = &model.bodies[*body];
        let of = |body: usize| drafts.iter().position(|draft| draft.body == body);
        let group = |body: usize| {
            let same = |draft: &Draft<'_>| model.rigid(draft.group).contains(&body);
            drafts.iter().position(same)
        };
        let Some(parent) = parent.and_then(|parent| of(parent).or_else(|| group(parent))) else {
            continue;
        };
        let Some(child) = of(*body).or_else(|| group(*body)) else { continue };
        let along = |limits: &Option<[f64; 2]>, turned: bool| {
            limits.map(|[low, high]| match turned {
                false => Span { low, high },
                true => Span { low: -high, high: -low },
            })
        };
        let kind = match motion {
            Motion::Hinge { axis, at, limits } if axis.xy().norm() < 1e-3 => {
                let limits = along(limits, axis.z < 0.0);
                JointKind::Revolute { at: Vector::new(at.x, at.y), limits }
            }
            Motion::Slide { axis, limits } if axis.z.abs() < 1e-3 => {
                let limits = along(limits, false);
                JointKind::Prismatic { axis: axis.xy().normalize(), limits }
            }
            _ => {
                let message =
                    format!("`{name}` is attached to another body by {}", held_by(motion));
                let advice = "joints between objects are fixed, turn about the vertical, or slide \
                              along the table";
                ledger.fault(*place, message, advice);
                continue;
            }
        };
        found.push(Joint::new([parent, child], kind));
    }
    found
}
