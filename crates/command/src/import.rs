//! `pushplan import`: tools and objects of other programs.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use pushplan::asset::write_atomic;
use pushplan::geometry::Vector;
use pushplan_import::{Imported, ImportedScene, Language, Reading, Wanted, objects, read, tool};

use super::{error::CliError, exit_code, session::Session};

/// Import a tool or objects from a file of MuJoCo (MJCF) or ROS (URDF), or a mesh (STL, OBJ, DAE)
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:
  pushplan import gripper.urdf --as tool --out tools/gripper.yaml
  pushplan import scene.xml --as objects --body can --body box --out tasks/mine.yaml
  pushplan import mug.stl --as objects --density 2400

Without --out, the file is printed. `pushplan import --help` explains the conversion.",
    after_long_help = "Conversion:

  objects    Free bodies on the table (one plane or box) or up to 25 cm above it. A body is free
             with <freejoint/>, with two slides and a hinge, or by --free NAME. In URDF it is free
             without a parent or on a floating joint of `world`. A body becomes one object. Its
             solids become parts; many solids are reduced to parts that cover the same area.
             Vertical hinges and slides along the table become joints, also to the world. Small
             spheres under a solid become its support points. An immovable body becomes an
             obstacle, its bounding box. Robot, tools and a missing goal are placeholders.
  meshes     STL, OBJ, DAE and MSH, inside a file or given directly. The convex hull, which MuJoCo
             and Bullet also use, becomes a prism of up to eight corners or an upright cylinder, or
             a stack of them if it bulges above the table. A non-convex mesh given directly is
             split into parts, and separate solids become separate objects. A warning states the
             error of the outline.
  assumed    If nothing else makes sense, the only body is free, the unit of a mesh makes it an
             object on a table, missing masses follow from 1000 kg/m^3, and bodies that cannot
             be imported are left out. Warnings state it; --strict refuses instead.
  includes   Files in or below the folder of the file, or in or below --root.
  tool       One body with everything fixed to it, undersides level, in the frame of the body.
             Its mass, its joints and its actuators are ignored.
  mass       <inertial> if present; otherwise MuJoCo's rule, mass or density (1000 kg/m^3) times
             volume; otherwise --density. The mass of a body is split over its solids by volume,
             so that the centre of mass is kept. A box with an eccentric centre of mass becomes
             a prism.
  friction   In MJCF the first number of `friction` (default 1); in URDF <lateral_friction>, <mu1>,
             <mu> or Drake's element; otherwise --friction. For two objects, MuJoCo uses the
             larger value or a <pair>, and pushplan the mean. Pairs with different results are
             listed under `frictions`. A tool and an object always use the mean.
  visuals    Visual shapes (contype and conaffinity 0, <visual>) contribute mass but no shape.

Every attribute is read, harmless, a warning with its effect on motion, or an error with a \
remedy. Warnings with a strong effect come first."
)]
pub struct ImportArgs {
    /// MJCF or URDF file, or mesh (STL, OBJ, DAE)
    file: PathBuf,
    /// Kind of file to create
    #[arg(long = "as", value_enum, value_name = "WHAT")]
    kind: What,
    /// Body or link to import, repeatable [default: all, or the only one]
    #[arg(long = "body", value_name = "NAME")]
    bodies: Vec<String>,
    /// Body to treat as free although the file fixes it, repeatable
    #[arg(long, value_name = "NAME")]
    free: Vec<String>,
    /// Treat free bodies to which others are jointed as fixed, like a cabinet against a wall
    #[arg(long)]
    fixed: bool,
    /// Refuse instead of assuming a unit, a density, a free body or the bodies to leave out
    #[arg(long)]
    strict: bool,
    /// Unit of a mesh [default: m, or the unit that makes it an object on a table]
    #[arg(long, value_enum)]
    unit: Option<Unit>,
    /// Density of bodies without a stated mass, kg/m^3: wood 700, plastic 1000, aluminium 2700,
    /// steel 7800 [default: 1000, and the task calls masses unknown]
    #[arg(long, value_name = "VALUE", value_parser = positive)]
    density: Option<f64>,
    /// Name of the tool or task [default: the name of the model, otherwise of the file]
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Friction coefficient of bodies without a stated one
    #[arg(long, value_name = "VALUE", default_value_t = Wanted::FRICTION)]
    friction: f64,
    /// Translation of all objects on the table, metres
    #[arg(long, value_name = "X,Y", value_parser = shift, allow_hyphen_values = true,
          default_value = "0,0")]
    shift: Vector,
    /// File to write; without it, the result is printed
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum What {
    /// Tool file
    Tool,
    /// Task file with the objects and obstacles
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
        fixed: args.fixed,
        density: args.density,
        name: args.name.clone(),
        friction: args.friction,
        shift: args.shift,
    };
    let reading = Reading {
        root: session.root().map(Path::to_path_buf),
        unit: args.unit.map(Unit::metres),
        strict: args.strict,
    };
    let (model, language) = read(&args.file, &reading)?;
    let from = from(&file, language);
    let (text, notes) = match args.kind {
        What::Tool => {
            let Imported { value, notes } = tool(&model, &file, &wanted)?;
            (format!("{from}\n{}", value.to_yaml()?), notes)
        }
        What::Objects => {
            let Imported { value, notes } = objects(&model, &file, &wanted)?;
            let ImportedScene { task, has_goal } = value;
            let yours = if has_goal { "robot and tools" } else { "robot, tools and goal" };
            let header = format!("{from} Placeholders to edit: {yours}.");
            (format!("{header}\n{}", task.to_yaml()?), notes)
        }
    };
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
        _ => Err("expected a number above 0, such as 700 for wood".to_owned()),
    }
}

/// Parses `x,y` in metres.
fn shift(text: &str) -> Result<Vector, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|word| word.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some([x, y]) if x.is_finite() && y.is_finite() => Ok(Vector::new(*x, *y)),
        _ => Err("expected two numbers, such as 0.5,-0.1".to_owned()),
    }
}
