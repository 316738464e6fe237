//! Every refusal comes with advice that works when followed. Each row holds a faulty file, words of
//! the advice, and the file or options changed according to it.

mod bodies;
mod files;
mod links;
mod numbers;

use pushplan_import::{Wanted, objects, parse, tool};

/// Target of an import.
#[derive(Clone, Copy, Debug, PartialEq)]
enum As {
    Objects,
    Tool,
}

use As::{Objects as O, Tool as T};

/// Returns the notes of a strict import, or all its faults.
fn import(text: &str, what: As, wanted: &Wanted) -> Result<String, String> {
    let (mut model, _) = parse(text, "f").map_err(|faults| faults.to_string())?;
    model.strict = true;
    let notes = match what {
        O => objects(&model, "f", wanted).map(|made| made.notes),
        T => tool(&model, "f", wanted).map(|made| made.notes),
    };
    notes.map(|notes| notes.join("\n")).map_err(|faults| faults.to_string())
}

/// Faulty file, words of the advice, and the replacements that follow it.
type Row<'a> = (String, &'a str, &'a [(&'a str, &'a str)]);

/// Asserts that every file is refused with its advice, and accepted after all its edits.
fn edited(what: As, rows: &[Row<'_>]) {
    let wrong = rows.iter().filter_map(|(text, advice, edits)| {
        let followed = edits.iter().fold(text.clone(), |text, (from, to)| text.replace(from, to));
        let all = Wanted::default();
        helped((text, what, &all), advice, (&followed, &all)).err()
    });
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// Returns `true` if a file with these options is refused with this advice, and accepted when it is
/// followed.
fn helped(
    (text, what, first): (&str, As, &Wanted),
    advice: &str,
    (followed, then): (&str, &Wanted),
) -> Result<(), String> {
    let Err(fault) = import(text, what, first) else { return Err(format!("is taken: {text}")) };
    let mut helps = fault.lines().filter(|line| line.trim_start().starts_with("help:"));
    if !helps.any(|help| help.contains(advice)) {
        return Err(format!("`{advice}` is not in\n{fault}{text}"));
    }
    let taken = import(followed, what, then);
    taken.map(|_| ()).map_err(|faults| format!("after following `{advice}`:\n{faults}{followed}"))
}

const BOX: &str = "<geom type='box' size='.05 .04 .05'/>";

/// Returns an MJCF file with a plane and these bodies.
fn mjcf(bodies: &str) -> String {
    format!("<mujoco><worldbody><geom type='plane' size='1 1 1'/>{bodies}</worldbody></mujoco>")
}

/// Returns an MJCF file with one free body that contains `inside`.
fn free(inside: &str) -> String {
    mjcf(&format!("<body name='b' pos='.5 0 .05'><freejoint/>{inside}</body>"))
}

/// Returns an MJCF file with `sections` before its free body.
fn with(sections: &str, inside: &str) -> String {
    free(inside).replace("<mujoco>", &format!("<mujoco>{sections}"))
}

/// Returns a URDF link with its mass and this shape.
fn link(name: &str, shape: &str) -> String {
    format!(
        "<link name='{name}'><inertial><mass value='.5'/></inertial>\
         <collision><geometry>{shape}</geometry></collision></link>"
    )
}

fn urdf(inside: &str) -> String {
    format!("<robot name='r'>{inside}</robot>")
}

/// Returns two links with a joint of this type between them that contains `inside`.
fn jointed(kind: &str, inside: &str) -> String {
    let cube = "<box size='.1 .1 .1'/>";
    urdf(&format!(
        "{}{}<joint name='j' type='{kind}'><parent link='a'/><child link='b'/>\
         <origin xyz='.2 0 0'/>{inside}</joint>",
        link("a", cube),
        link("b", cube)
    ))
}

/// Returns the corners of a cube with this side, metres.
fn cube(side: f64) -> String {
    let corner =
        |k: u32| [k & 1, k >> 1 & 1, k >> 2].map(|bit| (side * f64::from(bit)).to_string());
    (0..8).map(|k| corner(k).join(" ")).collect::<Vec<_>>().join(" ")
}

fn mesh(attributes: &str, side: f64) -> String {
    format!("<asset><mesh name='m' {attributes} vertex='{}'/></asset>", cube(side))
}

#[test]
fn options_follow_the_advice() {
    let named = |names: &[&str]| Wanted {
        bodies: names.iter().map(|name| (*name).to_owned()).collect(),
        ..Wanted::default()
    };
    let freed = |name: &str| Wanted { free: vec![name.to_owned()], ..Wanted::default() };
    let wood = Wanted { density: Some(700.0), ..Wanted::default() };
    let held = |joint: &str| mjcf(&format!("<body name='b' pos='.5 0 .05'>{joint}{BOX}</body>"));
    let high = free(BOX).replace(
        "</worldbody>",
        &format!("<body name='c' pos='.9 0 1.05'><freejoint/>{BOX}</body></worldbody>"),
    );
    let leaning = "<geom type='box' size='.3 .02 .02' pos='.5 0 .3' euler='0 45 0'/></worldbody>";
    let post = "<geom type='box' size='.15 .15 .1' pos='.5 0 .1'/></worldbody>";
    let inside = high.replace("1.05", ".05").replace("</worldbody>", post);
    let fixed = mjcf(&format!("<body name='a'>{BOX}</body><body name='b'>{BOX}</body>"));
    let jaw = mjcf(&format!("<body name='a'>{BOX}<body name='jaw'><joint/>{BOX}</body></body>"));
    let tendon = "<tendon><spatial/></tendon></mujoco>";
    for (text, what, advice, wanted) in [
        (held("<joint axis='0 1 0'/>"), O, "objects must be free (--free NAME", freed("b")),
        (held(""), O, "--free b makes it free", freed("b")),
        (high.clone(), O, "or select other bodies with --body", named(&["b"])),
        (inside, O, "move one of them, or select other bodies with --body", named(&["c"])),
        (free(BOX).replace("</worldbody>", leaning), O, "with --body it is ignored", named(&["b"])),
        (
            free(BOX).replace("</mujoco>", tendon),
            O,
            "remove it, or select bodies with --body",
            named(&["b"]),
        ),
        (
            high.replace("1.05", ".05")
                .replace("</mujoco>", "<contact><exclude body1='b' body2='c'/></contact></mujoco>"),
            O,
            "or select one of them with --body",
            named(&["b"]),
        ),
        (free(&BOX.replace("/>", " mass='0'/>")), O, "or its density, such as --density 700", wood),
        (fixed.clone(), T, "select one with --body: a, b", named(&["b"])),
        (jaw.clone(), T, "or select one with --body", named(&["jaw"])),
    ] {
        helped((&text, what, &Wanted::default()), advice, (&text, &wanted)).unwrap();
    }
    import(&held(""), T, &Wanted::default()).expect("`--as tool` imports a tool");
    // For unknown names, the advice lists the known ones.
    for (text, what, wrong, advice, right) in [
        (held(""), O, freed("x"), "bodies with solids are b", freed("b")),
        (held(""), O, named(&["b"]), "it is fixed; --free b makes it free", freed("b")),
        (free(BOX), O, named(&["x"]), "other movable bodies are b", named(&["b"])),
        (fixed, T, named(&["x"]), "select one with --body: a, b", named(&["a"])),
    ] {
        helped((&text, what, &wrong), advice, (&text, &right)).unwrap();
    }
}

#[test]
fn tools_become_one_piece_after_following_the_advice() {
    let tool = |inside: &str| mjcf(&format!("<body name='a'>{inside}</body>"));
    let many: String = (0..33)
        .map(|k| format!("<geom type='box' size='.01 .01 .02' pos='{} 0 0'/>", 0.02 * f64::from(k)))
        .collect();
    let jaw = "<body name='jaw' pos='.1 0 0'><joint/><geom type='box' size='.05 .04 .05'/></body>";
    let above = format!("{BOX}<geom type='box' size='.05 .04 .03' pos='.1 0 .02'/>");
    let rough = format!("{BOX}<geom type='box' size='.05 .04 .05' pos='.1 0 0' friction='.4'/>");
    let unseen = "contype='0' conaffinity='0'";
    let hidden = format!("pos='0 0 0' {unseen}");
    let above_unseen = format!("pos='.1 0 .02' {unseen}");
    let rows: &[Row<'_>] = &[
        (tool(&format!("{BOX}{jaw}")), "fix it", &[("<joint/>", "")]),
        (tool(&format!("{BOX}{jaw}")), "remove it", &[(jaw, "")]),
        (tool(&many), "remove those that meet no object", &[("pos='0 0 0'", &hidden)]),
        (
            tool(&above),
            "extend it down",
            &[("size='.05 .04 .03' pos='.1 0 .02'", "size='.05 .04 .05' pos='.1 0 0'")],
        ),
        (tool(&above), "disable its collision", &[("pos='.1 0 .02'", &above_unseen)]),
        (tool(&rough), "a single friction value; use one for all parts", &[("friction='.4'", "")]),
        (
            tool(&BOX.replace("/>", " euler='0 20 0'/>")),
            "rotate it by multiples of 90 degrees",
            &[("'0 20 0'", "'90 0 0'")],
        ),
        (
            tool("<geom type='sphere' size='.05'/>"),
            "replace it by a box, an upright cylinder",
            &[("type='sphere' size='.05'", "type='box' size='.05 .05 .05'")],
        ),
        (
            tool(""),
            "solids with collision: <geom>",
            &[("<body name='a'>", "<body name='a'><geom type='box' size='.05 .04 .05'/>")],
        ),
    ];
    edited(T, rows);
}
