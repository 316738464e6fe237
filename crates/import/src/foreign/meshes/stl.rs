//! STL, binary or text, with one solid or several.
//!
//! Normals, names and the attributes of triangles have no meaning here and are not checked, because
//! many programs write them wrongly.

use std::collections::HashMap;

use pushplan::geometry::Vector3;

use super::{Triangles, triangulated};

/// Length of the header, with the number of triangles, and of a triangle, bytes.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// Reads the triangles of all solids.
pub(super) fn stl(bytes: &[u8]) -> Result<Triangles, String> {
    let polygons = if is_text(bytes) { text(bytes)? } else { binary(bytes)? };
    let (mut numbers, mut points) = (HashMap::new(), Vec::new());
    let mut number = |corner: &[f64; 3]| {
        *numbers.entry(corner.map(f64::to_bits)).or_insert_with(|| {
            points.push(Vector3::from(*corner));
            points.len() as u32 - 1
        })
    };
    let polygons: Vec<Vec<u32>> =
        polygons.iter().map(|polygon| polygon.iter().map(&mut number).collect()).collect();
    let faces = polygons.iter().flat_map(|polygon| triangulated(&points, polygon)).collect();
    Ok((points, faces))
}

/// Returns `true` for the text form. Some programs start binary files with its keyword, but only
/// binary files contain zeros.
fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.get(..bytes.len().min(512)).unwrap_or_default();
    let word = String::from_utf8_lossy(start).trim_start_matches('\u{feff}').trim().to_lowercase();
    !start.contains(&0) && (word.starts_with("solid") || word.starts_with("facet"))
}

/// Reads binary solids, one after the other.
fn binary(mut bytes: &[u8]) -> Result<Vec<Vec<[f64; 3]>>, String> {
    let mut found = Vec::new();
    while !bytes.is_empty() {
        let count = bytes.get(80..HEADER).and_then(|four| four.try_into().ok());
        let count = count.map(u32::from_le_bytes).ok_or("it ends within its header")? as usize;
        let (rest, all) = (bytes.len() - HEADER, count.saturating_mul(TRIANGLE));
        // A wrong count of the only solid does no harm, because the length states it as well.
        let all = match all > rest || found.is_empty() && all == 0 {
            true if rest.is_multiple_of(TRIANGLE) => rest,
            true => {
                return Err(format!("it states {count} triangles, but its length does not match"));
            }
            false => all,
        };
        let number =
            |four: &[u8]| four.try_into().map_or(0.0, |four| f64::from(f32::from_le_bytes(four)));
        for triangle in bytes[HEADER..HEADER + all].chunks_exact(TRIANGLE) {
            let numbers: Vec<f64> = triangle[12..48].chunks_exact(4).map(number).collect();
            if !numbers.iter().all(|number| number.is_finite()) {
                return Err(format!("corner of triangle {} is not a number", found.len() + 1));
            }
            found.push(numbers.chunks_exact(3).map(|xyz| [xyz[0], xyz[1], xyz[2]]).collect());
        }
        bytes = &bytes[HEADER + all..];
    }
    Ok(found)
}

/// Reads solids written as text, in small letters or capitals.
fn text(bytes: &[u8]) -> Result<Vec<Vec<[f64; 3]>>, String> {
    let text = String::from_utf8_lossy(bytes).to_lowercase();
    let (mut found, mut loop_) = (Vec::new(), Vec::new());
    for (line, words) in text.lines().enumerate() {
        let mut words = words.split_whitespace();
        while let Some(word) = words.next() {
            match word {
                // The rest of the line is a name.
                "solid" | "endsolid" => break,
                "vertex" => {
                    let mut corner = [0.0; 3];
                    for number in &mut corner {
                        let word = words.next().unwrap_or("nothing");
                        let read = word.parse().ok().filter(|number: &f64| number.is_finite());
                        *number =
                            read.ok_or(format!("line {}: `{word}` is not a coordinate", line + 1))?;
                    }
                    loop_.push(corner);
                }
                "endloop" if loop_.len() < 3 => {
                    return Err(format!("line {}: a face of {} corners", line + 1, loop_.len()));
                }
                "endloop" => found.push(std::mem::take(&mut loop_)),
                _ => {}
            }
        }
    }
    match loop_.is_empty() && !found.is_empty() {
        true => Ok(found),
        false => Err("it ends within a face".to_owned()),
    }
}
