//! Reader for the kinematic chain of an arm in a URDF.

use std::collections::HashMap;
use std::path::Path;

use roxmltree::{Document, Node};

use super::hull::Hull;
use super::mesh_files;
use super::model::{Arm, ArmBody, ArmJoint, ToolMount};
use super::places::Places;
use pushplan::asset::read_text;
use pushplan::geometry::{Footprint, Pose3, Turn3, Vector3};
use pushplan_import::Outline;
use pushplan_import::foreign::urdf::{Geometry, Origin, axis, end, geometry, limit, origin};
use pushplan_import::foreign::xml::{Flaw, element, elements};
use pushplan_import::foreign::{Refused, load};

use super::read::Wrong;

/// Largest plausible length, metres, and mesh coordinate, in the mesh's own unit.
const FARTHEST: f64 = 1e5;

/// URDF file with its parsed document.
struct File<'a> {
    path: &'a Path,
    document: &'a Document<'a>,
}

/// Reads the arm in a file from its root to the link `flange`. The base is at the origin, the tool
/// mount is not set, and the home position is the middle of the joint limits.
pub(crate) fn chain(path: &Path, flange: &str) -> Result<Arm, Wrong> {
    let (_, text) = read_text(path)
        .map_err(|fault| (format!("{}: {}", fault.file, fault.message), fault.advice))?;
    let document = Document::parse(&text).map_err(|error| {
        (
            format!("{}: not valid XML: {error}", path.display()),
            "is this the right file?".to_owned(),
        )
    })?;
    let file = File { path, document: &document };
    let root = document.root_element();
    if !root.has_tag_name("robot") {
        return Err(file.wrong(
            root,
            "this is not a URDF file: <robot> is missing",
            "is this the right file?",
        ));
    }
    file.arm(root, flange)
}

impl<'a> File<'a> {
    fn wrong(&self, node: Node, message: impl Into<String>, advice: impl Into<String>) -> Wrong {
        self.flawed(Flaw::of(node, message, advice))
    }

    fn flawed(&self, Flaw { at, message, advice }: Flaw) -> Wrong {
        let place = self.document.text_pos_at(at);
        let (path, row, column) = (self.path.display(), place.row, place.col);
        (format!("{path}:{row}:{column}: {message}"), advice)
    }

    fn arm(&self, root: Node<'a, 'a>, flange: &str) -> Result<Arm, Wrong> {
        let named = |tag: &'static str| elements(root).filter(move |node| node.has_tag_name(tag));
        let links: HashMap<&str, Node> =
            named("link").filter_map(|node| Some((node.attribute("name")?, node))).collect();
        // Joints by child link.
        let mut joints: HashMap<&str, Node> = HashMap::new();
        for joint in named("joint") {
            if joints.insert(end(joint, "child"), joint).is_some() {
                let message =
                    format!("the link `{}` is the child of two joints", end(joint, "child"));
                return Err(self.wrong(joint, message, "a link can have only one parent"));
            }
        }
        if !links.contains_key(flange) {
            let mut known: Vec<&str> = links.keys().copied().collect();
            known.sort_unstable();
            let message = format!("there is no link `{flange}`");
            return Err(self.wrong(
                root,
                message,
                format!("the file has the links {}", known.join(", ")),
            ));
        }
        // The chain is collected from the flange upwards, then reversed.
        let mut chain = Vec::new();
        let mut link = flange;
        while let Some(joint) = joints.get(link) {
            if chain.len() > joints.len() {
                return Err(self.wrong(*joint, "these joints form a loop", "remove one of them"));
            }
            chain.push(*joint);
            link = end(*joint, "parent");
        }
        chain.reverse();
        let mut arm = Arm {
            name: root.attribute("name").unwrap_or("arm").to_owned(),
            base: Pose3::default(),
            joints: Vec::new(),
            bodies: vec![ArmBody { name: link.to_owned(), solids: Vec::new() }],
            pairs: Vec::new(),
            flange: Pose3::default(),
            mount: ToolMount { length: 0.0, yaw: 0.0 },
            home: Vec::new(),
            places: Places::default(),
        };
        let branches = Branches { links: &links, joints: &joints, flange };
        let on_chain: Vec<&str> = chain.iter().map(|joint| end(*joint, "child")).collect();
        let mut pose = Pose3::default();
        self.collect(&branches, (link, pose, true), &on_chain, &mut arm.bodies[0].solids)?;
        for joint in chain {
            let child = end(joint, "child");
            pose = pose * self.origin(joint)?;
            if joint.attribute("type") != Some("fixed") {
                arm.joints.push(self.joint(joint, pose)?);
                arm.bodies.push(ArmBody { name: child.to_owned(), solids: Vec::new() });
                pose = Pose3::default();
            }
            let resting = arm.joints.is_empty();
            if let Some(body) = arm.bodies.last_mut() {
                self.collect(&branches, (child, pose, resting), &on_chain, &mut body.solids)?;
            }
        }
        arm.flange = pose;
        arm.home = arm.joints.iter().map(ArmJoint::middle).collect();
        Ok(arm)
    }

    /// Collects the solids of a link, and of links that are fixed to it outside the chain. Other
    /// joints outside the chain count as fixed if they are `resting`, as in a second arm.
    fn collect(
        &self,
        branches: &Branches<'_, 'a>,
        (link, pose, resting): (&str, Pose3, bool),
        on_chain: &[&str],
        solids: &mut Vec<Hull>,
    ) -> Result<(), Wrong> {
        let mut left = vec![(link, pose)];
        let mut seen = 0;
        while let Some((link, pose)) = left.pop() {
            if let Some(node) = branches.links.get(link) {
                for collision in elements(*node).filter(|node| node.has_tag_name("collision")) {
                    solids.push(self.solid(collision, &pose)?);
                }
            }
            seen += 1;
            if link == branches.flange || seen > branches.links.len() {
                continue;
            }
            let mut fixed: Vec<_> = branches.joints.iter().collect();
            fixed.sort_by_key(|(child, _)| **child);
            for (child, joint) in fixed {
                let beside = !on_chain.contains(child);
                let fixed = joint.attribute("type") == Some("fixed");
                if beside && end(*joint, "parent") == link && (fixed || resting) {
                    let origin = pose * self.origin(*joint)?;
                    // Joints of kinds that no arm has, such as mimicking fingers, are left out.
                    let at = if fixed { Some(origin) } else { self.rest_of(*joint, origin) };
                    left.extend(at.map(|at| (*child, at)));
                }
            }
        }
        Ok(())
    }

    /// Returns the frame of a joint at rest; `None` for joints of kinds that no arm has.
    fn rest_of(&self, joint: Node<'a, 'a>, origin: Pose3) -> Option<Pose3> {
        self.joint(joint, origin).ok().map(|joint| joint.at_rest())
    }

    fn joint(&self, joint: Node<'a, 'a>, origin: Pose3) -> Result<ArmJoint, Wrong> {
        let name = joint.attribute("name").unwrap_or_default().to_owned();
        let axis = axis(joint).map_err(|flaw| self.flawed(flaw))?;
        if element(joint, "mimic").is_some() {
            let message =
                format!("joint `{name}` follows another joint (<mimic>), which is not supported");
            return Err(self.wrong(joint, message, "choose a `flange` before it"));
        }
        let kind = joint.attribute("type").unwrap_or_default();
        let slides = kind == "prismatic";
        let number = |name: &str| limit(joint, name).map_err(|flaw| self.flawed(flaw));
        let [lower, upper, speed] = [number("lower")?, number("upper")?, number("velocity")?];
        let limits = match kind {
            "continuous" => None,
            "revolute" | "prismatic" => {
                let limits = [lower.unwrap_or(0.0), upper.unwrap_or(0.0)];
                if limits[0] >= limits[1] {
                    let message = format!("joint `{name}` has an empty range of positions");
                    let advice = "write <limit lower=... upper=.../>, or the type `continuous`";
                    return Err(self.wrong(joint, message, advice));
                }
                Some(limits)
            }
            other => {
                let message = format!("joint `{name}` has the type `{other}`");
                let advice = "joints of arms must be revolute, continuous, prismatic or fixed";
                return Err(self.wrong(joint, message, advice));
            }
        };
        Ok(ArmJoint {
            name,
            slides,
            origin,
            axis,
            limits,
            max_speed: speed.filter(|speed| *speed > 0.0),
        })
    }

    fn solid(&self, collision: Node<'a, 'a>, pose: &Pose3) -> Result<Hull, Wrong> {
        let own = *pose * self.origin(collision)?;
        let shape = geometry(collision).map_err(|flaw| self.flawed(flaw))?;
        let positive = |name: &str, size: f64| match size > 0.0 && size < FARTHEST {
            true => Ok(size),
            false => {
                let message = format!("its `{name}` must be positive and less than {FARTHEST}");
                Err(self.wrong(collision, message, "lengths are in metres"))
            }
        };
        let outline = match shape {
            Geometry::Mesh { file, scale } => return self.mesh(collision, (&file, scale), &own),
            Geometry::Solid(outline) => outline,
        };
        match outline {
            Outline::Box(half) => Ok(Hull::cuboid(half.into(), &own)),
            Outline::Sphere(radius) => {
                Ok(Hull { points: vec![own.position], radius: positive("radius", radius)? })
            }
            Outline::Cylinder { radius, half } => {
                let (radius, half) = (positive("radius", radius)?, positive("length", half)?);
                Ok(Hull::prism(&Footprint::Disc { radius }, [-half, half], &own))
            }
            Outline::Capsule { radius, half } => {
                let (radius, half) = (positive("radius", radius)?, positive("length", half)?);
                let points = [half, -half].map(|z| own.point(Vector3::z() * z)).to_vec();
                Ok(Hull { points, radius })
            }
            other => {
                let tag = if let Outline::Other(tag) = other { tag } else { "solid".to_owned() };
                let message = format!("a {tag} is not supported");
                Err(self.wrong(collision, message, "use a box, cylinder or mesh"))
            }
        }
    }

    fn mesh(
        &self,
        collision: Node,
        (name, scale): (&str, [f64; 3]),
        own: &Pose3,
    ) -> Result<Hull, Wrong> {
        let refused = |Refused { message, advice }| self.wrong(collision, message, advice);
        let path = mesh_files::find(self.path, name).map_err(refused)?;
        let (corners, _) = load(&path).map_err(refused)?;
        if corners.iter().flatten().any(|number| number.is_nan() || number.abs() >= FARTHEST) {
            return Err(self.wrong(collision, "this mesh is damaged", "export it again"));
        }
        let scale = Vector3::from(scale);
        let corners: Vec<Vector3> =
            corners.iter().map(|corner| own.point(corner.component_mul(&scale))).collect();
        Hull::around(&corners)
            .ok_or_else(|| self.wrong(collision, "this mesh has no corners", "export it again"))
    }

    fn origin(&self, node: Node<'a, 'a>) -> Result<Pose3, Wrong> {
        let Origin { xyz, rpy: [x, y, z] } = origin(node).map_err(|flaw| self.flawed(flaw))?;
        if xyz.iter().chain(&[x, y, z]).any(|number| number.abs() >= FARTHEST) {
            let advice = "lengths are in metres, angles in radians";
            return Err(self.wrong(node, "the origin of this element is too far away", advice));
        }
        Ok(Pose3 { position: xyz.into(), rotation: Turn3::from_euler_angles(x, y, z) })
    }
}

/// Links and joints of the kinematic tree.
struct Branches<'b, 'a> {
    links: &'b HashMap<&'a str, Node<'a, 'a>>,
    joints: &'b HashMap<&'a str, Node<'a, 'a>>,
    flange: &'b str,
}
