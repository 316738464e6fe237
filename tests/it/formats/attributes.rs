//! Every attribute of the elements that are read is used, harmless, noted or refused, and does what
//! its treatment states.

mod in_mujoco;

use pushplan_import::{Language, Treatment, Wanted, objects, parse, treatment};

use super::kinds::Taken;

const MJCF: &str = include_str!("mjcf-attributes.txt");
const URDF: &str = include_str!("urdf-attributes.txt");

/// File of all MJCF elements that are read; `@element` marks the place of its attributes.
const SCENE: &str = "<mujoco @mujoco>
<compiler @compiler/><option @option><flag @flag/></option><default @default></default>
<custom><numeric name='n' data='1' @numeric/><text name='t' data='x' @text/></custom>
<asset><mesh name='m' vertex='0 0 0 .1 0 0 .1 .06 0 0 .06 0 0 0 .05 .1 0 .05 .1 .06 .05 0 .06 .05' @mesh/></asset>
<worldbody><geom type='plane' size='2 2 1'/>
<frame @frame><body name='a' pos='.5 0 .05' @body><freejoint @freejoint/><geom name='g' type='box' size='.05 .04 .05' @geom/></body></frame>
<body name='c' pos='.5 .4 .05'><freejoint/><inertial mass='.3' pos='0 0 0' diaginertia='1e-3 1e-3 1e-3' @inertial/><geom name='h' type='box' size='.05 .04 .05'/></body>
<body name='e' pos='.5 -.4 .05'><freejoint/><geom type='mesh' mesh='m' mass='.2'/></body>
<body name='d' pos='.9 .4 .05'><joint name='j' type='slide' axis='1 0 0' range='0 .1' @joint/><geom type='box' size='.05 .04 .05' mass='.4'/></body>
<replicate count='2' offset='0 .2 0' @replicate><body name='r' pos='.9 -.4 .05'><freejoint/><geom type='box' size='.03 .03 .05'/></body></replicate>
</worldbody>
<contact><pair geom1='g' geom2='h' @pair/><exclude body1='e' body2='none' @exclude/></contact>
<equality>@equality</equality><keyframe><key @key/></keyframe></mujoco>";

/// File of all URDF elements that are read.
const ROBOT: &str = "<robot name='r' @robot><link name='a' @link>
<inertial><origin xyz='0 0 .05'/><mass value='.5' @mass/><inertia ixx='1e-3' iyy='1e-3' izz='1e-3' @inertia/></inertial>
<collision @collision><origin @origin/><geometry>@shape</geometry></collision>
<contact><lateral_friction @lateral_friction/><rolling_friction @rolling_friction/><spinning_friction @spinning_friction/>
<stiffness @stiffness/><damping @damping/><restitution @restitution/><contact_cfm @contact_cfm/><contact_erp @contact_erp/>
<inertia_scaling @inertia_scaling/></contact></link>
<link name='b'><inertial><mass value='.5'/></inertial><collision><geometry><box size='.1 .1 .1'/></geometry></collision></link>
<joint name='j' type='revolute' @joint><origin xyz='.3 0 0'/><parent link='a' @parent/><child link='b' @child/><axis xyz='0 0 1' @axis/>
<limit lower='-.4' upper='.5' @limit/><dynamics @dynamics/><safety_controller @safety_controller/><calibration @calibration/>@mimic</joint></robot>";

/// Values with an effect, by attribute; names in quotes are of elements in the files above.
const VALUES: &[(&str, &str)] = &[
    ("active", "true"),
    ("angle", "radian"),
    ("armature", "2"),
    ("assetdir", "x"),
    ("autolimits", "false"),
    ("axis", "0 1 0"),
    ("axisangle", "0 0 1 20"),
    ("body1", "a"),
    ("body2", "c"),
    ("boundinertia", "1"),
    ("boundmass", "1"),
    ("coordinate", "global"),
    ("count", "3"),
    ("damping", "2"),
    ("density", "500"),
    ("diaginertia", "1e-3 1e-3 1e-3"),
    ("euler", "0 0 20"),
    ("eulerseq", "ZYX"),
    ("exactmeshinertia", "true"),
    ("face", "0 1 2"),
    ("fitscale", "2"),
    ("friction", ".3"),
    ("frictionloss", "1"),
    ("fromto", "0 0 .05 0 0 -.05"),
    ("fullinertia", "1e-3 1e-3 1e-3 0 0 0"),
    ("gap", ".01"),
    ("geom1", "g"),
    ("geom2", "h"),
    ("gravcomp", "1"),
    ("gravity", "0 0 -1"),
    ("inertiafromgeom", "true"),
    ("inertiagrouprange", "1 2"),
    ("ixx", "1e-3"),
    ("joint1", "j"),
    ("margin", ".01"),
    ("mass", ".7"),
    ("mesh", "m"),
    ("mocap", "true"),
    ("offset", "0 .3 0"),
    ("override", "enable"),
    ("pos", ".01 .02 0"),
    ("priority", "1"),
    ("quat", "1 0 0 .2"),
    ("radius", ".04"),
    ("range", "0 .05"),
    ("ref", ".01"),
    ("refpos", ".01 0 0"),
    ("refquat", "1 0 0 .2"),
    ("relpose", "1 0 0 1 0 0 0"),
    ("rgba", "1 0 0 1"),
    ("rpy", "0 0 .3"),
    ("quat_xyzw", "0 0 .2 1"),
    ("scale", "1 2 1"),
    ("sep", "-"),
    ("settotalmass", "3"),
    ("shellinertia", "true"),
    ("size", ".06 .03 .05"),
    ("springdamper", ".1 1"),
    ("stiffness", "2"),
    ("type", "hinge"),
    ("vertex", "0 0 0 .1 0 0 .1 .08 0 0 .08 0 0 0 .05 .1 0 .05 .1 .08 .05 0 .08 .05"),
    ("wind", "1 0 0"),
    ("xyaxes", "1 .2 0 -.2 1 0"),
    ("xyz", ".01 .02 0"),
    ("zaxis", "0 0 -1"),
    ("condim", "6"),
    ("contype", "1"),
    ("conaffinity", "1"),
    ("fitaabb", "true"),
    ("strippath", "true"),
    ("adhesion", "1"),
    ("surfacevel", "1 0 0"),
    ("torquescale", "0"),
    ("site1", "s"),
    ("site2", "s"),
    ("maxhullvert", "8"),
    ("equality", "disable"),
    ("qpos", "0 0 0"),
    ("filename", "x.stl"),
    ("length", ".1"),
    ("lower", "-.2"),
    ("upper", ".2"),
    ("link", "a"),
    ("group", "0"),
    ("childclass", "main"),
    ("class", "main"),
    ("limited", "false"),
];

/// Attributes that name something, or state a value that is the default; they need not change a
/// task.
const NAMES: &[&str] = &[
    "active",
    "angle",
    "assetdir",
    "body",
    "body1",
    "body2",
    "builtin",
    "childclass",
    "class",
    "conaffinity",
    "contype",
    "data",
    "equality",
    "eulerseq",
    "exactmeshinertia",
    "face",
    "file",
    "filename",
    "fitaabb",
    "fitscale",
    "geom1",
    "geom2",
    "gravity",
    "hfield",
    "inertia",
    "inertiafromgeom",
    "joint1",
    "joint2",
    "link",
    "meshdir",
    "model",
    "name",
    "params",
    "prefix",
    "group",
    "priority",
    "sep",
    "strippath",
    "type",
    "mocap",
    "diaginertia",
    "fullinertia",
    "ixx",
    "ixy",
    "ixz",
    "iyy",
    "iyz",
    "izz",
    "ref",
    "joint",
    "zaxis",
    "length",
    "autolimits",
    "limited",
];

/// Returns the file with an attribute of an element.
fn with(language: Language, element: &str, attribute: &str) -> String {
    let value = VALUES.iter().find(|(name, _)| *name == attribute).map_or("1", |(_, value)| value);
    let value = match (element, attribute) {
        ("flag", "gravity" | "contact" | "constraint" | "limit") => "disable",
        ("cylinder" | "sphere" | "capsule", "length" | "radius") => ".05",
        ("box", "size") => ".1 .08 .06",
        ("limit" | "dynamics" | "inertia", _) if value == "1" => "1e-3",
        ("mass", "value") => ".7",
        ("inertia_scaling", _) => "3",
        ("axis", "xyz") => "0 0 -1",
        ("child", "link") => "b",
        ("joint", "type") if language == Language::Urdf => "continuous",
        ("inertial", "pos") => ".01 0 0",
        ("joint", "pos" | "zaxis") => "0 0 0",
        (_, value) if value == "scale" && language == Language::Urdf => "1 1 1",
        _ => value,
    };
    let file = if language == Language::Urdf { ROBOT } else { SCENE };
    let own = match attribute {
        "" => String::new(),
        // Without a mass, its surface would weigh 50 kg.
        "shellinertia" => format!("mass='1' {attribute}='{value}'"),
        _ => format!("{attribute}='{value}'"),
    };
    let mut text = file.replace(&format!("@{element}"), &own);
    if let Some(kind) = element.strip_prefix("equality/") {
        let bodies = if kind == "weld" { "body1='c' body2='a'" } else { "" };
        text = text.replace("@equality", &format!("<{kind} {bodies} {own}/>"));
    }
    if ["box", "cylinder", "sphere", "capsule", "mesh"].contains(&element) {
        text = text.replace("@shape", &format!("<{element} {own}/>"));
    }
    if element == "mimic" {
        text = text.replace("@mimic", &format!("<mimic {own}/>"));
    }
    plain(&once(&text, attribute, &own))
}

/// Removes an attribute that the element states before.
fn once(text: &str, attribute: &str, own: &str) -> String {
    if attribute.is_empty() {
        return text.to_owned();
    }
    let Some(at) = text.find(own) else { return text.to_owned() };
    let begin = text[..at].rfind('<').unwrap_or(0);
    let before = &text[begin..at];
    let Some(first) = before.find(&format!(" {attribute}='")) else { return text.to_owned() };
    let value = &before[first + attribute.len() + 3..];
    let end = first + attribute.len() + 4 + value.find('\'').unwrap_or(0);
    format!("{}{}{}", &text[..begin + first], &text[begin + end..at], &text[at..])
}

/// Removes all marks of attributes that are not written.
fn plain(text: &str) -> String {
    let text = text.replace("@shape", "<box size='.1 .1 .1'/>");
    text.split('@').enumerate().fold(String::new(), |done, (k, piece)| {
        let end = if k == 0 {
            0
        } else {
            piece.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(0)
        };
        done + &piece[end..]
    })
}

fn taken(text: &str) -> Taken {
    let (model, _) = parse(text, "f").map_err(|faults| faults.to_string())?;
    let made = objects(&model, "f", &Wanted::default()).map_err(|faults| faults.to_string())?;
    Ok((made.value.task, made.notes.join("\n")))
}

/// Returns the elements and attributes of a list.
fn listed(text: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    rows.filter_map(|line| line.split_once(": "))
        .flat_map(|(element, words)| words.split(' ').map(move |word| (element, word)))
}

#[test]
fn every_attribute_is_used_or_harmless_or_noted_or_refused() {
    let (mut wrong, mut counts) = (Vec::new(), [0; 4]);
    for (language, list) in [(Language::Mjcf, MJCF), (Language::Urdf, URDF)] {
        let plainly = taken(&plain(if list == URDF { ROBOT } else { SCENE })).expect("a task");
        for (element, attribute) in listed(list) {
            let Some(treatment) = treatment(language, element, attribute) else {
                wrong.push(format!("{element} {attribute}: not in the table"));
                continue;
            };
            counts[treatment as usize] += 1;
            // Elements without a place in the files above are judged by the table alone.
            let text = with(language, element, attribute);
            if ["attach", "model"].contains(&element) || !text.contains(&format!("{attribute}='")) {
                continue;
            }
            let made = taken(&text);
            // A constraint has an effect of its own.
            let usual = match element.starts_with("equality/") {
                true => taken(&with(language, element, "")).unwrap_or_else(|_| plainly.clone()),
                false => plainly.clone(),
            };
            let (usual, noted) = usual;
            let names = |text: &str| text.contains(&format!("`{attribute}`"));
            let sound = match (treatment, &made) {
                (Treatment::Refused, made) => {
                    let refused = format!("{attribute}=\"");
                    made.as_ref().is_err_and(|faults| faults.contains(&refused))
                        || made.as_ref().is_ok_and(|(_, notes)| notes.contains(&refused))
                }
                (Treatment::Noted, made) => made.as_ref().is_ok_and(|(_, notes)| names(notes)),
                (Treatment::Harmless, Ok((task, notes))) => {
                    task.scene == usual.scene
                        && notes.lines().count() <= noted.lines().count() + 1
                        && !names(notes)
                }
                (Treatment::Used, Err(faults)) => !faults.contains("unknown attribute"),
                (Treatment::Used, Ok((task, notes))) => {
                    !names(notes)
                        && (NAMES.contains(&attribute)
                            || element == "inertial"
                            || (element, attribute) == ("joint", "pos")
                            || *task != usual)
                }
                (Treatment::Harmless, Err(_)) => {
                    element.starts_with("equality") || element == "mimic"
                }
            };
            if !sound {
                let made = made.map(|(_, notes)| notes);
                wrong.push(format!("{element} {attribute}: {treatment:?}, but {made:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}\n{} wrong", wrong.join("\n"), wrong.len());
    assert!(
        counts.iter().all(|count| *count > 5) && counts.iter().sum::<usize>() > 250,
        "{counts:?}"
    );
    let unknown = with(Language::Mjcf, "geom", "weight");
    assert!(taken(&unknown).expect_err("a fault").contains("unknown attribute `weight`"));
    let unknown = with(Language::Urdf, "link", "weight");
    assert!(taken(&unknown).expect("a note").1.contains("`weight` of this link is ignored"));
}
