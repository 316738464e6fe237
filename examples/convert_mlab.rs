//! Converts the real pushes of MLab_EXP (Jiaji Zhou, Apache License 2.0) to recordings:
//! `cargo run --release --example convert_mlab -- FILE... --out FOLDER`. Every JSON file holds the
//! pushes of one plate; `--first N` limits their number. The example shows how to convert your own
//! data.
//!
//! The data state the fingertip as a point with an error of about 1 mm. The recording has a
//! cylinder of 2 mm radius. Its path is shifted by the radius away from the edge that the point
//! touches, so that the surfaces meet at the point. The object's position is its centre of mass.
//! The data state no frictions. Between tip and plate it is 0.5, because `pushplan fit` finds 0.46
//! to 0.54 in every file. Between plate and table it is 0.3; slow pushes depend neither on this
//! value nor on the plate's mass and height.
//!
//! Files with `head` and `path` hold pushes by a blade with two tips. The tips are such cylinders
//! behind the points, joined by a bar at the depth of the blade's hollow. The plate was observed
//! before and after a push, and the blade also during the push.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pushplan::recordings::{RecordedFrame, Recording};
use pushplan::scenes::{Support, Surface, Velocity};
use pushplan::{ConvexPolygon, Object, Part, Pose, Scene, Shape, Tool, Vector};
use serde::Deserialize;

/// Radius of the cylinder that represents the fingertip, metres.
const TIP: f64 = 0.002;
/// Thickness of the bar between the tips of a blade, metres.
const BAR: f64 = 0.01;
/// Height of plate and fingertip, metres.
const HEIGHT: f64 = 0.02;
/// Coefficients of friction with the fingertip and with the table.
const ON_TIP: f64 = 0.5;
const ON_TABLE: f64 = 0.3;

/// File of pushes, in metres, seconds and degrees.
#[derive(Deserialize)]
struct Pushes {
    shape: Plate,
    support: Stands,
    head: Option<Blade>,
    pushes: Vec<Push>,
}

/// Two tips in the frame of a blade that points along x, and the depth of the hollow between them.
#[derive(Deserialize)]
struct Blade {
    tips: [[f64; 2]; 2],
    hollow: f64,
}

#[derive(Deserialize)]
struct Plate {
    corners: Vec<[f64; 2]>,
    centre_of_mass: [f64; 2],
}

/// Three support points, or a word for the whole plate.
#[derive(Deserialize)]
#[serde(untagged)]
enum Stands {
    Points(Vec<[f64; 2]>),
    #[allow(dead_code)]
    Word(String),
}

/// Poses of the plate's frame and path of the fingertip or of the blade.
#[derive(Deserialize)]
struct Push {
    before: [f64; 3],
    after: [f64; 3],
    /// Time, x and y of a point.
    #[serde(default)]
    tip: Vec<[f64; 3]>,
    /// Time, x, y and heading of a blade.
    #[serde(default)]
    path: Vec<[f64; 4]>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut files: Vec<PathBuf> = Vec::new();
    let (mut out, mut first) = (PathBuf::from("recordings"), usize::MAX);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let value = |next: Option<String>| next.ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--out" => out = value(arguments.next())?.into(),
            "--first" => first = value(arguments.next())?.parse()?,
            _ => files.push(argument.into()),
        }
    }
    for file in &files {
        let folder = out.join(file.file_stem().unwrap_or_default());
        std::fs::create_dir_all(&folder)?;
        let given: Pushes = serde_json::from_str(&std::fs::read_to_string(file)?)?;
        for (index, push) in given.pushes.iter().take(first).enumerate() {
            let name = format!("{}-{index:02}", stem(file));
            recording(&name, &given, push)?
                .write(folder.join(format!("push-{index:02}.recording.json")))?;
        }
        println!("{}", folder.display());
    }
    Ok(())
}

fn stem(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn recording(name: &str, given: &Pushes, push: &Push) -> Result<Recording, Box<dyn Error>> {
    let vector = |[x, y]: [f64; 2]| Vector::new(x, y);
    let corners: Vec<Vector> = given.shape.corners.iter().copied().map(vector).collect();
    let centre = vector(given.shape.centre_of_mass);
    let support = match &given.support {
        Stands::Points(points) => {
            Support::Points(points.iter().map(|point| vector(*point) - centre).collect())
        }
        Stands::Word(_) => Support::Even,
    };
    // The object's position is its centre of mass.
    let placed = |[x, y, degrees]: [f64; 3]| {
        let frame = Pose::new(x, y, degrees.to_radians());
        Pose { position: frame.point(centre), heading: frame.heading }
    };
    let (before, after) = (placed(push.before), placed(push.after));
    let base = ConvexPolygon::balanced(&corners, centre)?;
    let plate = Object::new("plate", Shape::Prism { base, height: HEIGHT })
        .mass(1.0)
        .friction(ON_TABLE)
        .standing_on(support)
        .at(before.position.x, before.position.y, before.heading);
    let scene = Scene::new([plate]).on_table(ON_TABLE).with_friction(0, Surface::Tool, ON_TIP);
    if let Some(blade) = &given.head {
        return by_blade(name, (scene, after), blade, &push.path);
    }
    let tip = Part::new("tip", Shape::Cylinder { radius: TIP, height: HEIGHT }, Pose::default());

    let (Some(from), Some(to)) = (push.tip.first(), push.tip.last()) else {
        return Err("a push without a path".into());
    };
    // Direction away from the edge that is nearest to the point before the push.
    let start = before.local_point(Vector::new(from[1], from[2]));
    let away = base
        .faces()
        .max_by(|a, b| {
            let beyond = |(corner, normal): &(Vector, Vector)| normal.dot(&(start - corner));
            beyond(a).total_cmp(&beyond(b))
        })
        .map_or(Vector::zeros(), |(_, normal)| before.vector(normal) * TIP);
    let frame = |[time, x, y]: [f64; 3], pose: Pose| RecordedFrame {
        time,
        tool: Pose { position: Vector::new(x, y) + away, heading: 0.0 },
        lifted: false,
        seen: true,
        poses: vec![pose],
    };
    // The path is straight and uniform to 0.5 mm; the plate was observed only at its ends.
    let mut last = frame(*to, after);
    let first = frame(*from, before);
    last.unwrap_after(&first);
    Ok(Recording {
        name: name.into(),
        description: "MLab_EXP by Jiaji Zhou, Apache License 2.0, converted".into(),
        scene,
        tool: Arc::new(Tool::new("tip", [tip])?),
        lift: 0.0,
        headings: vec![true],
        velocities: vec![Velocity::default()],
        frames: vec![first, last],
    })
}

/// Returns the recording of a push by a blade with a recorded path; the plate was observed before
/// and after it.
fn by_blade(
    name: &str,
    (scene, after): (Scene, Pose),
    blade: &Blade,
    path: &[[f64; 4]],
) -> Result<Recording, Box<dyn Error>> {
    let round = Shape::Cylinder { radius: TIP, height: HEIGHT };
    let tip = |name: &str, [x, y]: [f64; 2]| Part::new(name, round, Pose::new(x - TIP, y, 0.0));
    let [left, right] = blade.tips;
    let size = [BAR, (left[1] - right[1]).abs(), HEIGHT];
    let bar = Part::cuboid("bar", size, Pose::new(-blade.hollow - 0.5 * BAR, 0.0, 0.0));
    let parts = [tip("left", left), tip("right", right), bar];
    let tool = Tool::joined("blade", parts, &[[0, 2], [1, 2]])?;
    let before = scene.objects[0].pose;
    let mut frames: Vec<RecordedFrame> = Vec::new();
    for (k, [time, x, y, degrees]) in path.iter().enumerate() {
        let last = k + 1 == path.len();
        let mut frame = RecordedFrame {
            time: time - path[0][0],
            tool: Pose::new(*x, *y, degrees.to_radians()),
            lifted: false,
            seen: k == 0 || last,
            poses: vec![if last { after } else { before }],
        };
        if let Some(earlier) = frames.last() {
            frame.unwrap_after(earlier);
        }
        frames.push(frame);
    }
    Ok(Recording {
        name: name.into(),
        description: "MLab_EXP by Jiaji Zhou, Apache License 2.0, converted".into(),
        scene,
        tool: Arc::new(tool),
        lift: 0.0,
        headings: vec![true],
        velocities: vec![Velocity::default()],
        frames,
    })
}
