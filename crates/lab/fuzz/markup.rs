//! Mutations of XML: attributes with other values, duplicated and missing elements.

use crate::random::Random;

/// Values of mutated attributes.
const VALUES: [&str; 16] = [
    "",
    "0",
    "-1",
    "nan",
    "1e308",
    "1e-308",
    "0 0 0",
    "0 0 0 0",
    "1 2",
    "0.05 0.05 0.05",
    "box",
    "mesh",
    "hinge",
    "90 0 0",
    "world",
    "\u{e9} b",
];

/// Returns `input` with one to four attributes or elements changed.
pub fn spoiled(input: &[u8], random: &mut Random) -> Vec<u8> {
    let mut text = String::from_utf8_lossy(input).into_owned();
    for _ in 0..=random.below(4) {
        let found = if random.once_in(3) { element(&text, random) } else { value(&text, random) };
        let Some((from, to)) = found else { continue };
        let piece = text[from..to].to_owned();
        match (piece.starts_with('<'), random.below(3)) {
            (true, 0) => text.replace_range(from..to, ""),
            (true, _) => text.insert_str(from, &piece),
            (false, _) => text.replace_range(from..to, random.pick::<&str>(&VALUES)),
        }
    }
    text.into_bytes()
}

/// Returns the range of the value of a random attribute.
fn value(text: &str, random: &mut Random) -> Option<(usize, usize)> {
    let starts: Vec<usize> = text.match_indices("=\"").map(|(at, _)| at + 2).collect();
    let from = *starts.get(random.below(starts.len().max(1)))?;
    Some((from, from + text[from..].find('"')?))
}

/// Returns the range of a random element without children.
fn element(text: &str, random: &mut Random) -> Option<(usize, usize)> {
    let ends: Vec<usize> = text.match_indices("/>").map(|(at, _)| at + 2).collect();
    let to = *ends.get(random.below(ends.len().max(1)))?;
    Some((text[..to].rfind('<')?, to))
}
