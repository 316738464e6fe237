//! Check for elements with too many attributes, because reading them takes quadratic time.

use pushplan::asset::{Fault, Place};

/// Maximum number of attributes of an element.
const MAX_ATTRIBUTES: usize = 256;

/// Returns a fault if an element of a text has too many attributes.
pub(super) fn crowded(text: &str, file: &str) -> Option<Fault> {
    place(text).map(|place| Fault {
        file: file.to_owned(),
        place: Some(place),
        message: format!("an element has more than {MAX_ATTRIBUTES} attributes"),
        advice: "MJCF and URDF elements have a few dozen at most; is this the right file?"
            .to_owned(),
    })
}

fn place(text: &str) -> Option<Place> {
    let (mut begin, mut quote, mut count) = (None, None, 0);
    for (at, byte) in text.bytes().enumerate() {
        match (byte, quote) {
            (b'"' | b'\'', None) if begin.is_some() => quote = Some(byte),
            (_, Some(open)) if byte == open => quote = None,
            (_, Some(_)) => {}
            (b'<', None) => (begin, count) = (Some(at), 0),
            (b'>', None) => begin = None,
            (b'=', None) if begin.is_some() => count += 1,
            _ => {}
        }
        if count > MAX_ATTRIBUTES {
            let before = &text[..begin.unwrap_or_default()];
            let line = before.matches('\n').count() + 1;
            let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
            return Some(Place { line, column });
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_with_hundreds_of_attributes_are_refused_at_once() {
        let text = |count: usize| {
            let all: String = (0..count).map(|k| format!(" a{k}='<=>'")).collect();
            format!("<mujoco>\n <geom{all}/>\n</mujoco>")
        };
        assert_eq!(place(&text(MAX_ATTRIBUTES)), None);
        assert_eq!(place(&text(100_000)), Some(Place { line: 2, column: 2 }));
    }
}
