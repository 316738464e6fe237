//! OBJ: vertices and polygons; everything else of the format is appearance.

use pushplan::geometry::Vector3;

use super::{Triangles, triangulated};

/// Reads the triangles of all objects and groups.
pub(super) fn obj(bytes: &[u8]) -> Result<Triangles, String> {
    // Only comments and names have other characters than ASCII, in any encoding.
    let text = String::from_utf8_lossy(bytes);
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    let (mut polygons, mut joined) = (Vec::new(), String::new());
    for (line, words) in text.lines().enumerate() {
        // A backslash continues a line.
        if let Some(begun) = words.trim_end().strip_suffix('\\') {
            joined += begun;
            joined.push(' ');
            continue;
        }
        let whole = std::mem::take(&mut joined) + words;
        let wrong = |word: &str, what: &str| format!("line {}: `{word}` is not {what}", line + 1);
        let mut words = whole.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("v") => {
                let mut corner = [0.0; 3];
                for number in &mut corner {
                    let word = words.next().unwrap_or("nothing");
                    let read = word.parse().ok().filter(|number: &f64| number.is_finite());
                    *number = read.ok_or_else(|| wrong(word, "a coordinate"))?;
                }
                points.push(Vector3::from(corner));
            }
            Some("f") => {
                let corner = |word: &str| {
                    let number = word.split('/').next().unwrap_or_default().parse::<i64>().ok();
                    // Negative numbers count back from the last vertex so far.
                    let index = number.map(|k| if k < 0 { points.len() as i64 + k } else { k - 1 });
                    let index = index.and_then(|index| u32::try_from(index).ok());
                    index.ok_or_else(|| wrong(word, "a vertex"))
                };
                let polygon: Vec<u32> = words.map(corner).collect::<Result<_, _>>()?;
                polygons.push((line, polygon));
            }
            _ => {}
        }
    }
    for (line, polygon) in polygons {
        if let Some(index) = polygon.iter().find(|index| **index as usize >= points.len()) {
            return Err(format!("line {}: there is no vertex {}", line + 1, index + 1));
        }
        faces.extend(triangulated(&points, &polygon));
    }
    Ok((points, faces))
}
