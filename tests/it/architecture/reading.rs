//! Reading of sources, and of the names in their code.

use std::fs;
use std::path::{Path, PathBuf};

use crate::ROOT;

/// Returns the code of a file without comments. Test modules are included, because they would also
/// couple the modules.
pub(crate) fn code_of(text: &str) -> String {
    let code = |line: &str| line.split("//").next().unwrap_or_default().to_owned() + "\n";
    text.lines().map(code).collect()
}

/// Returns the names after `crate::` in the code of a file, in order; `crate::{a::b, c}` contains
/// several.
pub(crate) fn imports(text: &str, start: &str) -> Vec<String> {
    let code = code_of(text);
    let mut found = Vec::new();
    for after in code.split(start).skip(1) {
        let Some(list) = after.strip_prefix('{') else {
            found.push(first_word(after));
            continue;
        };
        // Names are at the depth of the list itself.
        let (mut depth, mut item) = (1, String::new());
        for c in list.chars() {
            depth += i32::from(c == '{') - i32::from(c == '}');
            if depth == 0 || depth == 1 && c == ',' {
                found.push(first_word(item.trim()));
                item.clear();
            } else {
                item.push(c);
            }
            if depth == 0 {
                break;
            }
        }
    }
    // Nothing follows the last comma of a list.
    found.retain(|name| !name.is_empty());
    found
}

/// Returns `true` if the code uses an item of the crate `name`.
pub(crate) fn names(code: &str, name: &str) -> bool {
    let path = format!("{name}::");
    let inner = |c| in_word(c) || c == ':';
    code.match_indices(&path).any(|(at, _)| !code[..at].ends_with(inner))
}

fn first_word(text: &str) -> String {
    text.chars().take_while(|c| in_word(*c)).collect()
}

pub(crate) fn in_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Returns every Rust file under `folder`, with its path relative to the repository.
pub(crate) fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    let root = Path::new(ROOT);
    let mut found = Vec::new();
    let mut folders = vec![root.join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the repository") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                let text = fs::read_to_string(&path).expect("a source file");
                let path = path.strip_prefix(root).expect("inside the repository").to_path_buf();
                found.push((path, text));
            }
        }
    }
    assert!(!found.is_empty());
    found.sort();
    found
}
