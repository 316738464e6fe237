//! Reader for the kinematic chain of an arm in a URDF.

use std::collections::BTreeMap;
use std::path::Path;

use roxmltree::{Document, Node};

use super::hull::Hull;
use super::mesh_files;
use super::model::{Arm, ArmBody, ArmJoint, ToolMount};
use super::places::Places;
use pushplan::asset::read_text;
use pushplan::geometry::{Footprint, Pose3, Turn3, Vector3};
use pushplan_import::Outline;
use pushplan_import::foreign::urdf::{Geometry, Origin, axis, end, geometry, origin};
use pushplan_import::foreign::xml::{Flaw, element, elements, number};
use pushplan_import::foreign::{Refused, load};

use super::read::Wrong;

/// Largest plausible length, metres, and mesh coordinate, in the mesh's own unit.
const FARTHEST: f64 = 1e5;

/// Magnitude from which a limit of a joint stands for none: positions and speeds in radians or
/// metres, and their derivatives.
const NO_POSITION: f64 = 1e3;
const NO_RATE: f64 = 1e6;

/// Range of a joint whose only other limit stands for none, radians and metres.
const OPEN: [f64; 2] = [4.0 * std::f64::consts::PI, 2.0];

/// Remedy for a file of macros.
const EXPAND: &str = "expand its macros first: `xacro FILE > arm.urdf`, then name arm.urdf here";

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
        let advice = if text.contains("<xacro:") { EXPAND } else { "is this the right file?" };
        (format!("{}: not valid XML: {error}", path.display()), advice.to_owned())
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
    if let Some(macros) = root.descendants().find(|node| has_macros(*node)) {
        return Err(file.wrong(macros, "this is a xacro file, not a URDF", EXPAND));
    }
    file.arm(root, flange)
}

/// Returns `true` for an element of xacro, or one with an expression of xacro.
fn has_macros(node: Node) -> bool {
    let space = node.tag_name().namespace();
    let expression = |text: &str| text.contains("${") || text.contains("$(");
    space.is_some_and(|space| space.contains("xacro"))
        || node.attributes().any(|attribute| expression(attribute.value()))
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
        let links: BTreeMap<&str, Node> =
            named("link").filter_map(|node| Some((node.attribute("name")?, node))).collect();
        // Joints by child link.
        let mut joints: BTreeMap<&str, Node> = BTreeMap::new();
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
            beside: Vec::new(),
            pairs: Vec::new(),
            flange: Pose3::default(),
            mount: ToolMount { length: 0.0, yaw: 0.0 },
            home: Vec::new(),
            places: Places::default(),
        };
        let mut on_chain: Vec<&str> = chain.iter().map(|joint| end(*joint, "child")).collect();
        on_chain.push(link);
        let branches = Branches { links: &links, joints: &joints, flange, on_chain: &on_chain };
        let mut pose = Pose3::default();
        self.collect(&branches, (link, pose), &mut arm)?;
        for joint in chain {
            let child = end(joint, "child");
            pose = pose * self.origin(joint)?;
            match self.leader(&branches, joint)? {
                _ if joint.attribute("type") == Some("fixed") => (),
                Some(position) => {
                    pose = self.joint(joint, pose)?.pose(position);
                }
                None => {
                    arm.joints.push(self.joint(joint, pose)?);
                    arm.bodies.push(ArmBody { name: child.to_owned(), solids: Vec::new() });
                    pose = Pose3::default();
                }
            }
            self.collect(&branches, (child, pose), &mut arm)?;
        }
        arm.flange = pose;
        arm.home = arm.joints.iter().map(ArmJoint::middle).collect();
        Ok(arm)
    }

    /// Collects the solids of a link on the chain, and of its other branches at rest, such as a
    /// gripper. Links on movable branches of the resting part of the arm, such as a second arm, are
    /// collected as separate bodies.
    fn collect(
        &self,
        branches: &Branches<'_, 'a>,
        (link, pose): (&'a str, Pose3),
        arm: &mut Arm,
    ) -> Result<(), Wrong> {
        let resting = arm.joints.is_empty();
        let mut left = vec![(link, pose, false)];
        let mut seen = 0;
        while let Some((link, pose, beside)) = left.pop() {
            let mut solids = Vec::new();
            if let Some(node) = branches.links.get(link) {
                for collision in elements(*node).filter(|node| node.has_tag_name("collision")) {
                    solids.push(self.solid(collision, &pose)?);
                }
            }
            match arm.bodies.last_mut() {
                _ if beside && solids.is_empty() => (),
                Some(body) if !beside => body.solids.extend(solids),
                _ => arm.beside.push(ArmBody { name: link.to_owned(), solids }),
            }
            seen += 1;
            if link == branches.flange || seen > branches.links.len() {
                continue;
            }
            for (child, joint) in branches.joints {
                if !branches.on_chain.contains(child) && end(*joint, "parent") == link {
                    let origin = pose * self.origin(*joint)?;
                    let moves = joint.attribute("type") != Some("fixed");
                    // Joints of kinds that no arm has are at their origin.
                    let at = match self.joint(*joint, origin) {
                        Ok(one) if moves => one.pose(match self.leader(branches, *joint)? {
                            Some(position) => position,
                            None => one.rest(),
                        }),
                        _ => origin,
                    };
                    left.push((child, at, beside || resting && moves));
                }
            }
        }
        Ok(())
    }

    /// Returns the position of a joint that follows another one at rest (`mimic`); `None` if it
    /// follows none.
    fn leader(
        &self,
        branches: &Branches<'_, 'a>,
        joint: Node<'a, 'a>,
    ) -> Result<Option<f64>, Wrong> {
        let Some(mimic) = element(joint, "mimic") else { return Ok(None) };
        let number = |name: &str, usual: f64| match mimic.attribute_node(name) {
            Some(stated) => number(stated).map_err(|flaw| self.flawed(flaw)),
            None => Ok(usual),
        };
        let [factor, offset] = [number("multiplier", 1.0)?, number("offset", 0.0)?];
        let led =
            branches.joints.values().find(|one| one.attribute("name") == mimic.attribute("joint"));
        let Some(leader) = led.filter(|leader| element(**leader, "mimic").is_none()) else {
            let message =
                "this joint follows (<mimic>) a joint that does not exist or follows another";
            return Err(self.wrong(joint, message, "name the leading joint"));
        };
        let follows = branches.on_chain.contains(&end(joint, "child"));
        if follows && branches.on_chain.contains(&end(*leader, "child")) {
            let name = joint.attribute("name").unwrap_or_default();
            let message = format!(
                "joint `{name}` follows another joint of the arm (<mimic>), which is not supported"
            );
            return Err(self.wrong(joint, message, "choose a `flange` before it"));
        }
        Ok(Some(factor * self.joint(*leader, Pose3::default())?.rest() + offset))
    }

    fn joint(&self, joint: Node<'a, 'a>, origin: Pose3) -> Result<ArmJoint, Wrong> {
        let name = joint.attribute("name").unwrap_or_default().to_owned();
        let axis = axis(joint).map_err(|flaw| self.flawed(flaw))?;
        let kind = joint.attribute("type").unwrap_or_default();
        let slides = kind == "prismatic";
        let limit = element(joint, "limit");
        let rate = |name: &str| {
            let rate = self.bound((joint, limit), name, NO_RATE)?;
            Ok::<_, Wrong>(rate.filter(|rate| *rate > 0.0 && rate.is_finite()))
        };
        let limits = match kind {
            "continuous" => None,
            "revolute" | "prismatic" => {
                self.limits((joint, &name), limit, OPEN[usize::from(slides)])?
            }
            other => {
                let message = format!("joint `{name}` has the type `{other}`");
                let advice = "joints of arms must be revolute, continuous, prismatic or fixed";
                return Err(self.wrong(joint, message, advice));
            }
        };
        let max_speed = rate("velocity")?.filter(|speed| *speed < NO_POSITION);
        let [max_acceleration, max_jerk] = [rate("acceleration")?, rate("jerk")?];
        Ok(ArmJoint { name, slides, origin, axis, limits, max_speed, max_acceleration, max_jerk })
    }

    /// Returns the position limits of a joint, narrowed by its soft limits; `None` without limits.
    fn limits(
        &self,
        (joint, name): (Node<'a, 'a>, &str),
        limit: Option<Node<'a, 'a>>,
        open: f64,
    ) -> Result<Option<[f64; 2]>, Wrong> {
        let bound = |of, name: &str| self.bound((joint, of), name, NO_POSITION);
        let [low, high] =
            [bound(limit, "lower")?, bound(limit, "upper")?].map(Option::unwrap_or_default);
        let soft = element(joint, "safety_controller");
        let soft = [bound(soft, "soft_lower_limit")?, bound(soft, "soft_upper_limit")?];
        let narrow = [low.max(soft[0].unwrap_or(low)), high.min(soft[1].unwrap_or(high))];
        let [low, high] = if narrow[0] < narrow[1] { narrow } else { [low, high] };
        if low >= high {
            let message = format!("joint `{name}` has an empty range of positions");
            let advice = "write <limit lower=... upper=.../>, or the type `continuous`";
            return Err(self.wrong(joint, message, advice));
        }
        Ok(match [low.is_finite(), high.is_finite()] {
            [true, true] => Some([low, high]),
            [true, false] => Some([low, low + open]),
            [false, true] => Some([high - open, high]),
            [false, false] => None,
        })
    }

    /// Returns a number of an element, infinite if its magnitude stands for none; `None` if it is
    /// not stated.
    fn bound(
        &self,
        (joint, of): (Node<'a, 'a>, Option<Node<'a, 'a>>),
        name: &str,
        none: f64,
    ) -> Result<Option<f64>, Wrong> {
        let Some(stated) = of.and_then(|of| of.attribute_node(name)) else { return Ok(None) };
        match stated.value().trim().parse::<f64>() {
            Ok(value) if value.abs() >= none => Ok(Some(value.signum() * f64::INFINITY)),
            Ok(value) if value.is_nan() => {
                Err(self.wrong(joint, format!("`{name}` is not a number"), "write a number"))
            }
            _ => number(stated).map(Some).map_err(|flaw| self.flawed(flaw)),
        }
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
    links: &'b BTreeMap<&'a str, Node<'a, 'a>>,
    joints: &'b BTreeMap<&'a str, Node<'a, 'a>>,
    flange: &'b str,
    /// Names of the links from the root to the flange.
    on_chain: &'b [&'a str],
}
