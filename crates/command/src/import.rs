//! `pushplan import`: tools and objects of other programs.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use pushplan::asset::write_atomic;
use pushplan::geometry::Vector;
use pushplan_import::{Imported, ImportedScene, Language, Reading, Wanted, objects, read, tool};

use super::{error::CliError, exit_code, session::Session};

/// Import a tool or objects from a file of MuJoCo (MJCF) or ROS (URDF), or from a mesh (STL, OBJ)
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:
  pushplan import gripper.urdf --as tool --out tools/gripper.yaml
  pushplan import scene.xml --as objects --body can --body box --out tasks/mine.yaml
  pushplan import mug.stl --as objects --unit mm --density 2400

Without --out the file is printed. `pushplan import --help` says what is imported as what.",
    after_long_help = "What is imported as what:

  objects    Bodies that stand freely (<freejoint/>, two slides and a hinge, --free NAME; in URDF a link
             without a parent, or on a floating joint of `world`) on one plane or box, the table, or up
             to 25 cm above it. A body is one object; of several solids it has parts, of many those that
             cover the same. Hinges about the vertical and slides along the table become joints, to the
             world as well. Small spheres under a solid are the points that it stands on. What does not
             move is an obstacle: the box around it. Robot and tools, and the goal where the file has
             none, stand for yours.
  meshes     STL, OBJ and MSH, of the file or by themselves: the prism of up to eight corners, or the
             upright cylinder, over what the convex hull covers, as MuJoCo and Bullet have it. A mesh by
             itself that is not convex has parts. A warning says how far the outline is off.
  includes   Files in or below the folder of the file, or that of --root.
  tool       One body with all that is fixed to it, undersides level. Its frame is that of the body.
             What it weighs, and what holds or moves it, does not matter.
  mass       <inertial> if it is there, else MuJoCo's rule: mass, or density (1000 kg/m^3) times volume,
             else --density. One mass of several solids is split by volume, so that the centre of mass
             is where it should be. A centre of mass off the middle makes a box a prism.
  friction   The first number of `friction` in MJCF (1 by default); in URDF <lateral_friction>,
             <mu1>, <mu> or Drake's, else --friction. MuJoCo takes the larger value of a pair, or that of a <pair>,
             where pushplan takes the mean: pairs that differ are listed under `frictions`. Of a tool
             and an object it is the mean.
  shapes that are only seen (contype and conaffinity 0, <visual>) weigh, but are left out.

What pushplan cannot express is an error that says where and what to do. What it expresses only
roughly, such as damping of joints, is a warning."
)]
pub struct ImportArgs {
    /// An MJCF or URDF file, or a mesh (STL, OBJ)
    file: PathBuf,
    /// What to make of it
    #[arg(long = "as", value_enum, value_name = "WHAT")]
    kind: What,
    /// A body or link to import, several if repeated; by default all, or the only one
    #[arg(long = "body", value_name = "NAME")]
    bodies: Vec<String>,
    /// A body that stands freely although the file holds it, several if repeated
    #[arg(long, value_name = "NAME")]
    free: Vec<String>,
    /// Folder in and below which the file may name others (meshes, includes); by default its own
    #[arg(long, value_name = "FOLDER")]
    root: Option<PathBuf>,
    /// Unit of a mesh
    #[arg(long, value_enum, default_value_t = Unit::M)]
    unit: Unit,
    /// Density of bodies that state no mass, kg/m^3: wood 700, plastic 1000, aluminium 2700, steel 7800
    #[arg(long, value_name = "VALUE", value_parser = positive)]
    density: Option<f64>,
    /// Name of the tool or task; by default that of the model, or of the file
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Friction value of bodies that state none
    #[arg(long, value_name = "VALUE", default_value_t = Wanted::FRICTION)]
    friction: f64,
    /// Shift all objects on the table by this, metres
    #[arg(long, value_name = "X,Y", value_parser = shift, allow_hyphen_values = true,
          default_value = "0,0")]
    shift: Vector,
    /// File to write instead of printing it
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum What {
    /// A tool file
    Tool,
    /// A task file with the objects and obstacles
    Objects,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Unit {
    /// Millimetres
    Mm,
    /// Centimetres
    Cm,
    /// Metres
    M,
    /// Inches
    In,
}

impl Unit {
    fn metres(self) -> f64 {
        match self {
            Unit::Mm => 1e-3,
            Unit::Cm => 1e-2,
            Unit::M => 1.0,
            Unit::In => 0.0254,
        }
    }
}

pub fn run(args: &ImportArgs, session: &Session) -> Result<u8, CliError> {
    let file = args.file.display().to_string();
    let wanted = Wanted {
        bodies: args.bodies.clone(),
        free: args.free.clone(),
        density: args.density,
        name: args.name.clone(),
        friction: args.friction,
        shift: args.shift,
    };
    let reading = Reading { root: args.root.clone(), unit: args.unit.metres() };
    let (model, language, mut notes) = read(&args.file, &reading)?;
    let from = from(&file, language);
    let (text, more) = match args.kind {
        What::Tool => {
            let Imported { value, notes } = tool(&model, &file, &wanted)?;
            (format!("{from}\n{}", value.to_yaml()?), notes)
        }
        What::Objects => {
            let Imported { value, notes } = objects(&model, &file, &wanted)?;
            let ImportedScene { task, has_goal } = value;
            let yours = if has_goal { "robot and tools" } else { "robot, tools and goal" };
            let header = format!("{from} Yours to write: {yours}.");
            (format!("{header}\n{}", task.to_yaml()?), notes)
        }
    };
    notes.extend(more);
    for note in &notes {
        session.warn(note);
    }
    match &args.out {
        Some(path) => {
            write_atomic(path, text.as_bytes()).map_err(CliError::Output)?;
            session.print(&format!("wrote {}\n", path.display()))?;
        }
        None => session.print(&text)?,
    }
    Ok(exit_code::DONE)
}

/// Returns the first line of an imported file. Control characters are replaced because a line feed
/// in a name would end the comment.
fn from(file: &str, language: Language) -> String {
    let file = file.replace(char::is_control, " ");
    format!("# From {file} ({}).", language.name())
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("write a number above 0, such as 700 for wood".to_owned()),
    }
}

/// Parses `x,y` in metres.
fn shift(text: &str) -> Result<Vector, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|word| word.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some([x, y]) if x.is_finite() && y.is_finite() => Ok(Vector::new(*x, *y)),
        _ => Err("write two numbers such as 0.5,-0.1".to_owned()),
    }
}
