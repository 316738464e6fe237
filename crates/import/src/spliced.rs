//! Text of a file with all included files inserted.

use std::path::Path;

use roxmltree::Document;

use pushplan::asset::{self, Fault, Faults};

use super::crowd::crowded;
use super::model::Place;
use crate::foreign::Files;

/// Maximum number of included files, and maximum number of bytes in total.
const MOST: usize = 200;
const LONGEST: usize = 32 << 20;

/// Text assembled from several files.
#[derive(Debug, Default)]
pub(super) struct Spliced {
    /// Complete text.
    pub text: String,
    /// Start of each span in the text, index of its file and start in that file, in order.
    spans: Vec<(usize, usize, usize)>,
    files: Vec<Part>,
}

#[derive(Debug)]
struct Part {
    name: String,
    text: String,
    /// Byte offsets of the line starts.
    lines: Vec<usize>,
}

impl Spliced {
    /// Reads the text of `file` and of the files it includes.
    pub fn read(text: &str, file: &str, files: &Files) -> Result<Self, Faults> {
        let mut all = Self::default();
        let mut stack = Vec::new();
        all.take(text, file, files, &mut stack, true).map_err(Faults::from)?;
        Ok(all)
    }

    /// Returns the names of the files.
    pub fn names(&self) -> Vec<String> {
        self.files.iter().map(|part| part.name.clone()).collect()
    }

    /// Converts a byte offset in the text to a place in its file.
    pub fn place(&self, offset: usize) -> Place {
        let span = self.spans.partition_point(|(start, ..)| *start <= offset).saturating_sub(1);
        let Some((start, file, from)) = self.spans.get(span).copied() else {
            return Place::default();
        };
        self.files[file].place(file, offset - start + from)
    }

    fn take(
        &mut self,
        text: &str,
        name: &str,
        files: &Files,
        stack: &mut Vec<std::path::PathBuf>,
        whole: bool,
    ) -> Result<(), Fault> {
        let index = self.files.len();
        let ends = text.match_indices('\n').map(|(at, _)| at + 1);
        let lines = std::iter::once(0).chain(ends).collect();
        self.files.push(Part { name: name.to_owned(), text: text.to_owned(), lines });
        let document = document(text, name)?;
        let root = document.root_element();
        let tag = root.tag_name().name();
        let (mut from, end) = match (whole, root.first_child(), root.last_child()) {
            (true, ..) => (0, text.len()),
            (false, Some(first), Some(last)) => (first.range().start, last.range().end),
            (false, ..) => return Ok(()),
        };
        let fault = |node: roxmltree::Node<'_, '_>, message: String, advice: String, all: &Self| {
            let Place { line, column, .. } = all.files[index].place(index, node.range().start);
            let place = Some(asset::Place { line, column });
            Fault { file: name.to_owned(), place, message, advice }
        };
        let is_include = |node: &roxmltree::Node<'_, '_>| {
            ["mujoco", "mujocoinclude"].contains(&tag) && node.has_tag_name("include")
        };
        for node in root.descendants().filter(is_include) {
            self.append(index, from, &text[from..node.range().start]);
            from = node.range().end;
            let Some(named) = node.attribute("file") else {
                let advice = "add its `file`".to_owned();
                return Err(fault(node, "this <include> names no file".to_owned(), advice, self));
            };
            let path = files
                .find("", named)
                .or_else(|refused| {
                    // Relative to the main file, or to the included file that names it.
                    let folder = Path::new(name).parent().filter(|_| !whole);
                    let beside = folder.map(|folder| folder.join(named).display().to_string());
                    beside
                        .map_or(Err(refused.clone()), |beside| files.beside(&beside).ok_or(refused))
                })
                .map_err(|refused| fault(node, refused.message, refused.advice, self))?;
            if stack.contains(&path) || self.files.len() > MOST || self.text.len() > LONGEST {
                let message = "these files include each other, or are far too many".to_owned();
                return Err(fault(node, message, "break the cycle".to_owned(), self));
            }
            let bytes = Files::bytes(&path)
                .map_err(|refused| fault(node, refused.message, refused.advice, self))?;
            let Ok(inner) = String::from_utf8(bytes) else {
                let message = format!("{} is not UTF-8 text", path.display());
                return Err(fault(node, message, "is this the right file?".to_owned(), self));
            };
            let inner = inner.strip_prefix('\u{feff}').unwrap_or(&inner);
            let shown = Path::new(&self.files[0].name).parent().map(|folder| folder.join(named));
            let shown = shown.unwrap_or_else(|| named.into()).display().to_string();
            stack.push(path);
            self.take(inner, &shown, files, stack, false)?;
            stack.pop();
        }
        self.append(index, from, &text[from..end]);
        Ok(())
    }

    fn append(&mut self, file: usize, from: usize, text: &str) {
        self.spans.push((self.text.len(), file, from));
        self.text.push_str(text);
    }
}

impl Part {
    fn place(&self, file: usize, offset: usize) -> Place {
        let line = self.lines.partition_point(|start| *start <= offset).max(1);
        let before = self.text.get(self.lines[line - 1]..offset).unwrap_or_default();
        Place { file, line, column: before.chars().count() + 1 }
    }
}

/// Parses a text as XML.
pub(super) fn document<'a>(text: &'a str, file: &str) -> Result<Document<'a>, Fault> {
    if let Some(fault) = crowded(text, file) {
        return Err(fault);
    }
    Document::parse(text).map_err(|error| {
        let at = error.pos();
        Fault {
            file: file.to_owned(),
            place: Some(asset::Place { line: at.row as usize, column: at.col as usize }),
            message: format!("this is not valid XML: {error}"),
            advice: "MJCF and URDF are XML, meshes end in .stl or .obj; check other files with \
                     `pushplan check`"
                .to_owned(),
        }
    })
}
