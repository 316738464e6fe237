//! Access to files that a file names: only in its folder or below, unless a root folder is given.
//! Meshes may also be found up to three folders above.

use std::io::{ErrorKind, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use pushplan::plain_file;

/// Maximum size of a file, bytes; meshes have some megabytes.
const LONGEST: u64 = 64 << 20;

/// Maximum number of files that name further files, and their maximum nesting depth.
const MOST: usize = 200;
const DEEPEST: usize = 16;

/// Number of folders above the folder of a file in which meshes are searched, as in packages that
/// keep descriptions and meshes in separate folders.
const ABOVE: usize = 3;

/// Reason why a file is not read, with advice.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// Description of the fault.
    pub message: String,
    /// Suggested fix.
    pub advice: String,
}

/// Locations of the files that a file names.
#[derive(Clone, Debug, Default)]
pub struct Files {
    /// Folder of the file; `None` for a text without a file.
    folder: Option<PathBuf>,
    /// Folder that must contain all named files.
    root: Option<PathBuf>,
    /// Whether the root was given, and is not just the folder of the file.
    given: bool,
    /// The file and its chain of including files.
    trail: Vec<PathBuf>,
    /// Number of files found so far that name further files.
    entered: Arc<AtomicUsize>,
}

impl Files {
    /// Creates the access for the file `path`, restricted to `root` or the folder of the file.
    pub fn of(path: &Path, root: Option<&Path>) -> Self {
        let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
        let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
        let given = root.is_some();
        let root = root.map_or_else(|| folder.clone(), Path::to_path_buf);
        let trail = path.canonicalize().into_iter().collect();
        let (folder, root) = (Some(folder), Some(root));
        Self { folder, root, given, trail, entered: Arc::default() }
    }

    /// Finds the mesh `name` in folders around the file, within the root if one was given, although
    /// the file states the folder `base`.
    pub fn around(&self, base: &str, name: &str) -> Option<PathBuf> {
        let folder = self.folder.as_ref().filter(|_| !Path::new(name).is_absolute());
        let folder = folder?.canonicalize().ok()?;
        // The root folder of the file system is not a package.
        let above: Vec<&Path> =
            folder.ancestors().take(ABOVE + 1).filter(|above| above.parent().is_some()).collect();
        let given = self.root.as_ref().filter(|_| self.given);
        let root = given.map(|root| root.canonicalize().unwrap_or_default());
        let allowed = |path: &PathBuf| {
            path.is_file()
                && above.last().is_some_and(|highest| path.starts_with(highest))
                && root.as_ref().is_none_or(|root| path.starts_with(root))
        };
        let plain = name.split_once("://").map_or(name, |(_, rest)| rest);
        let plain = plain.trim_start_matches("../").trim_start_matches("./");
        let within = plain.split_once('/').map_or(plain, |(_, within)| within);
        let places = above.iter().flat_map(|above| [above.join(plain), above.join(within)]);
        std::iter::once(folder.join(base).join(name))
            .chain(places)
            .filter_map(|path| path.canonicalize().ok())
            .find(allowed)
    }

    /// Returns the access for another file that was found; `None` if the chain is circular or too
    /// long.
    pub fn within(&self, path: &Path) -> Option<Self> {
        let entered = self.entered.fetch_add(1, Ordering::Relaxed);
        if entered >= MOST || self.trail.len() >= DEEPEST || self.trail.iter().any(|on| on == path)
        {
            return None;
        }
        let trail = self.trail.iter().cloned().chain([path.to_path_buf()]).collect();
        Some(Self { folder: path.parent().map(Path::to_path_buf), trail, ..self.clone() })
    }

    /// Finds the file `name`, optionally in the folder `base` that the file states.
    pub fn find(&self, base: &str, name: &str) -> Result<PathBuf, Refused> {
        let (Some(folder), Some(root)) = (&self.folder, &self.root) else {
            return Err(Refused {
                message: format!(
                    "`{name}` is another file, but the input is a text without a folder"
                ),
                advice: "read the input from a file".to_owned(),
            });
        };
        let root = root.canonicalize().map_err(|error| Refused {
            message: format!("the folder {} cannot be read: {error}", root.display()),
            advice: "give an existing folder with --root".to_owned(),
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

    /// Returns the file at a path, if it exists and may be read.
    pub fn beside(&self, path: &str) -> Option<PathBuf> {
        let root = self.root.as_ref()?.canonicalize().ok()?;
        Path::new(path).canonicalize().ok().filter(|real| real.starts_with(root))
    }

    /// Finds a file of a ROS package, whose folder contains the file or is beside it.
    fn in_package(&self, root: &Path, rest: &str) -> Result<PathBuf, Refused> {
        let missing = || Refused {
            message: format!("there is no file package://{rest} in or below {}", root.display()),
            advice: "give the folder of the package, or its parent, with --root".to_owned(),
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

    /// Returns the bytes of a file found by [`Files::find`].
    pub fn bytes(path: &Path) -> Result<Vec<u8>, Refused> {
        let refused = |what: String, advice: &str| Refused {
            message: format!("{} {what}", path.display()),
            advice: advice.to_owned(),
        };
        let mut bytes = Vec::new();
        let read =
            plain_file::open(path).and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes));
        match read {
            Err(error) => {
                let advice = match error.kind() {
                    ErrorKind::InvalidInput => "name a plain file",
                    _ => "check the path",
                };
                Err(refused(format!("cannot be read: {error}"), advice))
            }
            Ok(_) if bytes.len() as u64 > LONGEST => {
                let what = format!("has more than {} megabytes", LONGEST >> 20);
                Err(refused(what, "make the mesh coarser"))
            }
            Ok(_) => Ok(bytes),
        }
    }
}

/// Returns the refusal of a file outside the root, with the folder to name instead.
fn outside(name: &str, root: &Path, real: &Path) -> Refused {
    let shared = root.components().zip(real.components()).take_while(|(a, b)| a == b);
    let shared: PathBuf =
        shared.map(|(part, _)| part).collect::<Vec<Component<'_>>>().iter().collect();
    Refused {
        message: format!("`{name}` is outside the folder of the file"),
        advice: format!("--root {} allows files in and below that folder", shared.display()),
    }
}
