//! Files that a file names: only those in its folder or below it, unless somebody says how far up.

use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The longest file that is read, bytes: meshes have some megabytes.
const LONGEST: u64 = 64 << 20;

/// The most files that name files in turn, and how many lead to one.
const MOST: usize = 200;
const DEEPEST: usize = 16;

/// What keeps a file from being read, and what to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// Description of the fault.
    pub message: String,
    /// Remedy.
    pub advice: String,
}

/// Where the files are that a file names.
#[derive(Clone, Debug, Default)]
pub struct Files {
    /// The folder of the file; none if there is a text alone.
    folder: Option<PathBuf>,
    /// The folder that they must be in or below.
    root: Option<PathBuf>,
    /// The file, and those that led to it.
    trail: Vec<PathBuf>,
    /// How many files were found that name files of their own.
    entered: Arc<AtomicUsize>,
}

impl Files {
    /// Those of the file `path`, in or below `root` or its own folder.
    pub fn of(path: &Path, root: Option<&Path>) -> Self {
        let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
        let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
        let root = root.map_or_else(|| folder.clone(), Path::to_path_buf);
        let trail = path.canonicalize().into_iter().collect();
        Self { folder: Some(folder), root: Some(root), trail, entered: Arc::default() }
    }

    /// Those of another file that it found; none where that leads in a circle, or to far too many.
    pub fn within(&self, path: &Path) -> Option<Self> {
        let entered = self.entered.fetch_add(1, Ordering::Relaxed);
        if entered >= MOST || self.trail.len() >= DEEPEST || self.trail.iter().any(|on| on == path)
        {
            return None;
        }
        let trail = self.trail.iter().cloned().chain([path.to_path_buf()]).collect();
        Some(Self { folder: path.parent().map(Path::to_path_buf), trail, ..self.clone() })
    }

    /// The file of that name, which `base`, a folder of the file's own, may stand before.
    pub fn find(&self, base: &str, name: &str) -> Result<PathBuf, Refused> {
        let (Some(folder), Some(root)) = (&self.folder, &self.root) else {
            return Err(Refused {
                message: format!("`{name}` is another file, and this is a text alone"),
                advice: "read it from a file".to_owned(),
            });
        };
        let root = root.canonicalize().map_err(|error| Refused {
            message: format!("the folder {} cannot be read: {error}", root.display()),
            advice: "name a folder with --root that exists".to_owned(),
        })?;
        let named = match name.split_once("://") {
            Some(("package", rest)) => return self.in_package(&root, rest),
            Some(("file", rest)) => PathBuf::from(rest),
            _ => folder.join(base).join(name),
        };
        let Ok(real) = named.canonicalize() else {
            return Err(Refused {
                message: format!("there is no file {}", named.display()),
                advice: "names are relative to the folder of the file".to_owned(),
            });
        };
        if real.starts_with(&root) {
            return Ok(real);
        }
        Err(outside(name, &root, &real))
    }

    /// The file at a path, if it exists and may be read.
    pub fn beside(&self, path: &str) -> Option<PathBuf> {
        let root = self.root.as_ref()?.canonicalize().ok()?;
        Path::new(path).canonicalize().ok().filter(|real| real.starts_with(root))
    }

    /// A file of a ROS package: its folder is one around the file, or stands beside it.
    fn in_package(&self, root: &Path, rest: &str) -> Result<PathBuf, Refused> {
        let missing = || Refused {
            message: format!("there is no file package://{rest} in or below {}", root.display()),
            advice: "name the folder of the package, or the one around it, with --root".to_owned(),
        };
        let within = rest.split_once('/').map_or(rest, |(_, within)| within);
        let folder = self.folder.as_ref().and_then(|folder| folder.canonicalize().ok());
        let around = folder.iter().flat_map(|folder| folder.ancestors());
        around
            .take_while(|folder| folder.starts_with(root))
            .flat_map(|folder| [folder.join(rest), folder.join(within)])
            .filter_map(|path| path.canonicalize().ok())
            .find(|path| path.starts_with(root) && path.is_file())
            .ok_or_else(missing)
    }

    /// The bytes of a file that [`Files::find`] found.
    pub fn bytes(path: &Path) -> Result<Vec<u8>, Refused> {
        let refused = |what: String, advice: &str| Refused {
            message: format!("{} {what}", path.display()),
            advice: advice.to_owned(),
        };
        let mut bytes = Vec::new();
        let read = File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes));
        match read {
            Err(error) => Err(refused(format!("cannot be read: {error}"), "check the path")),
            Ok(_) if bytes.len() as u64 > LONGEST => {
                let what = format!("has more than {} megabytes", LONGEST >> 20);
                Err(refused(what, "make the mesh coarser"))
            }
            Ok(_) => Ok(bytes),
        }
    }
}

/// Says which folder has to be named for a file that lies elsewhere.
fn outside(name: &str, root: &Path, real: &Path) -> Refused {
    let shared = root.components().zip(real.components()).take_while(|(a, b)| a == b);
    let shared: PathBuf =
        shared.map(|(part, _)| part).collect::<Vec<Component<'_>>>().iter().collect();
    Refused {
        message: format!("`{name}` lies outside of the file's own folder"),
        advice: format!("files in and below a folder may be read with --root {}", shared.display()),
    }
}
