//! Cycles of files inside a module, and types whose methods are spread over files; both counts may
//! only decrease.
//!
//! A file of `src` depends on another file of its module if its code names an item of that file,
//! directly or through re-exports. Only paths that begin with `super::` or `crate::` count.
//! Comments are ignored, test modules are not. Tables of contents (`mod.rs`) do not count as files.
//! Files that depend on one another, directly or through others, form a cycle.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use super::reading::{code_of, in_word, sources};

/// Maximum number of cycles, and of files in a cycle.
const CYCLES: usize = 8;
const LARGEST: usize = 6;

/// Maximum number of files with methods of one type.
const FILES_OF_A_TYPE: usize = 3;

/// Segments of a path: of a module from the crate's root, or of a name from its place of use.
type Segments = Vec<String>;

/// Files of a crate.
struct Files {
    /// Code by module.
    code: BTreeMap<Segments, String>,
    /// Modules that are tables of contents.
    tables: BTreeSet<Segments>,
    /// Names that modules re-export, with their paths.
    exports: HashMap<Segments, HashMap<String, Segments>>,
}

#[test]
fn cycles_of_files_inside_modules_only_fall() {
    let files = Files::of("src");
    let cycles = files.cycles();
    let largest = cycles.iter().map(Vec::len).max().unwrap_or_default();
    let list: Vec<String> = cycles.iter().map(|cycle| cycle.join(" ")).collect();
    assert!(
        cycles.len() <= CYCLES && largest <= LARGEST,
        "{} cycles, the largest of {largest} files:\n{}",
        cycles.len(),
        list.join("\n")
    );
    for module in ["plan", "solve"] {
        let cycle = list.iter().find(|cycle| cycle.starts_with(module));
        assert_eq!(cycle, None, "{module} has no cycles");
    }
}

#[test]
fn methods_of_a_type_stand_in_few_files() {
    let mut files: BTreeMap<(String, String), usize> = BTreeMap::new();
    for (path, text) in sources("src") {
        let Some(module) = module_of(&path).into_iter().next() else { continue };
        let types: BTreeSet<String> = text.lines().filter_map(type_of).collect();
        for name in types {
            *files.entry((module.clone(), name)).or_default() += 1;
        }
    }
    for ((module, name), count) in files {
        assert!(count <= FILES_OF_A_TYPE, "{module}::{name} has methods in {count} files");
    }
}

#[test]
fn cycles_are_found_through_re_exports() {
    let file = |name: &str| vec!["m".to_owned(), name.to_owned()];
    let mut files = Files {
        code: BTreeMap::from([
            (vec!["m".into()], code_of("mod a;\nmod b;\nmod c;\npub use b::{B, Other};")),
            (file("a"), code_of("use super::B; // super::c::C")),
            (file("b"), code_of("fn f() -> crate::m::a::A {}")),
            (file("c"), code_of("use super::{a::A, b};")),
        ]),
        tables: BTreeSet::from([vec!["m".into()]]),
        exports: HashMap::new(),
    };
    files.read_exports();
    assert_eq!(files.cycles(), [["m/a", "m/b"]]);
    assert_eq!(type_of("impl<'a> Search<'a> {").as_deref(), Some("Search"));
    assert_eq!(type_of("impl Progress for Quiet<'_> {"), None);
}

impl Files {
    fn of(folder: &str) -> Self {
        let mut files =
            Self { code: BTreeMap::new(), tables: BTreeSet::new(), exports: HashMap::new() };
        for (path, text) in sources(folder) {
            let module = module_of(&path);
            if path.ends_with("mod.rs") || module.is_empty() {
                files.tables.insert(module.clone());
            }
            // The roots of library and command are not modules.
            files.code.entry(module).or_default().push_str(&code_of(&text));
        }
        files.read_exports();
        files
    }

    fn read_exports(&mut self) {
        for (module, code) in &self.code {
            let own = self.exports.entry(module.clone()).or_default();
            for path in code.split(';').filter_map(exported).flat_map(tree) {
                if let Some(name) = path.last() {
                    own.insert(name.clone(), path.clone());
                }
            }
        }
    }

    /// Returns the cycles, each as the names of its files.
    fn cycles(&self) -> Vec<Vec<String>> {
        let files = self.code.keys().filter(|module| !self.tables.contains(*module));
        let uses: BTreeMap<&Segments, BTreeSet<Segments>> =
            files.map(|file| (file, self.uses(file))).collect();
        let reached: BTreeMap<&Segments, BTreeSet<&Segments>> =
            uses.keys().map(|file| (*file, reachable(&uses, file))).collect();
        let mut cycles: Vec<Vec<String>> = Vec::new();
        for (file, reach) in &reached {
            let cycle: Vec<&Segments> =
                reach.iter().filter(|other| reached[*other].contains(file)).copied().collect();
            if cycle.len() > 1 && cycle.first() == Some(file) {
                cycles.push(cycle.iter().map(|file| file.join("/")).collect());
            }
        }
        cycles
    }

    /// Returns the other files of its module that a file uses.
    fn uses(&self, file: &Segments) -> BTreeSet<Segments> {
        let code = &self.code[file];
        let starts = ["crate::", "super::"].into_iter().flat_map(|start| code.match_indices(start));
        let begins = |at: usize| !code[..at].ends_with(|c| in_word(c) || c == ':');
        let paths = starts.filter(|(at, _)| begins(*at)).flat_map(|(at, _)| tree(&code[at..]));
        let used = paths.filter_map(|path| self.resolve(file, &path, 0));
        let counts = |other: &Segments| {
            other.first() == file.first() && other != file && !self.tables.contains(other)
        };
        used.filter(counts).collect()
    }

    /// Returns the module in which a path ends that is written in `module`.
    fn resolve(&self, module: &Segments, path: &[String], depth: usize) -> Option<Segments> {
        let mut at = module.clone();
        let mut rest = path;
        while let Some((first, others)) = rest.split_first() {
            match first.as_str() {
                "crate" => at.clear(),
                "super" => drop(at.pop()),
                "self" => {}
                _ => break,
            }
            rest = others;
        }
        for (k, name) in rest.iter().enumerate() {
            let inner = [at.clone(), vec![name.clone()]].concat();
            let export = self.exports.get(&at).and_then(|exports| exports.get(name));
            if self.code.contains_key(&inner) {
                at = inner;
            } else if let Some(export) = export.filter(|_| depth < 8) {
                let path = [export.as_slice(), &rest[k + 1..]].concat();
                return self.resolve(&at, &path, depth + 1);
            } else {
                break;
            }
        }
        Some(at).filter(|at| !at.is_empty())
    }
}

fn reachable<'a>(
    uses: &'a BTreeMap<&'a Segments, BTreeSet<Segments>>,
    file: &'a Segments,
) -> BTreeSet<&'a Segments> {
    let mut reached = BTreeSet::new();
    let mut open = vec![file];
    while let Some(file) = open.pop() {
        for other in uses.get(file).into_iter().flatten() {
            if reached.insert(other) {
                open.push(other);
            }
        }
    }
    reached
}

/// Returns the module of a file: `src/plan/qp.rs` is `plan`, `qp`.
fn module_of(path: &Path) -> Segments {
    let parts = path.with_extension("");
    let parts = parts.components().skip(1).map(|part| part.as_os_str().to_string_lossy());
    let parts = parts.filter(|part| !["mod", "lib", "main"].contains(&part.as_ref()));
    parts.map(|part| part.into_owned()).collect()
}

/// Returns the paths of a statement that re-exports, without its keywords.
fn exported(statement: &str) -> Option<&str> {
    let begins = |line: &&str| {
        line.split_once("use ").is_some_and(|(before, _)| {
            before == "pub " || before.starts_with("pub(") && before.ends_with(") ")
        })
    };
    let line = statement.lines().map(str::trim_start).find(begins)?;
    let at = statement.find(line)?;
    statement[at..].split_once("use ").map(|(_, tree)| tree)
}

/// Returns the paths of a tree such as `a::{b, c::D}`, up to where it ends.
fn tree(text: &str) -> Vec<Segments> {
    let mut stack: Vec<Segments> = Vec::new();
    let (mut path, mut name, mut paths) = (Segments::new(), String::new(), Vec::new());
    for c in text.chars() {
        match c {
            c if in_word(c) => name.push(c),
            ':' if !name.is_empty() => path.push(std::mem::take(&mut name)),
            ':' => {}
            '{' => stack.push(path.clone()),
            ',' | '}' if !stack.is_empty() => {
                paths.extend(finished(&path, &name));
                name.clear();
                path = stack.last().cloned().unwrap_or_default();
                if c == '}' {
                    stack.pop();
                    if stack.is_empty() {
                        return paths;
                    }
                    path = stack.last().cloned().unwrap_or_default();
                }
            }
            c if c.is_whitespace() && !stack.is_empty() => {}
            _ => break,
        }
    }
    paths.extend(finished(&path, &name));
    paths
}

/// Returns the path that ends with `name`; `self` names the path itself.
fn finished(path: &[String], name: &str) -> Option<Segments> {
    match name {
        "" => None,
        "self" => Some(path.to_vec()),
        name => Some([path, &[name.to_owned()]].concat()),
    }
}

/// Returns the type whose methods begin on a line.
fn type_of(line: &str) -> Option<String> {
    let rest = line.strip_prefix("impl")?;
    let rest = match rest.strip_prefix('<') {
        Some(generics) => generics.split_once("> ")?.1,
        None => rest.strip_prefix(' ')?,
    };
    let name: String = rest.chars().take_while(|c| in_word(*c)).collect();
    (!rest.contains(" for ") && !name.is_empty()).then_some(name)
}
