//! Numbers with a fixed number of decimals.

/// Formats a number with `decimals` decimals; a number that rounds to zero has no sign.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|byte| matches!(byte, b'0' | b'.')) => rest.to_owned(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_has_no_sign() {
        assert_eq!([-0.0, -0.04, 0.04].map(|value| fixed(value, 1)), ["0.0"; 3]);
        assert_eq!(fixed(-0.4, 0), "0");
        assert_eq!(fixed(-0.0004, 3), "0.000");
        assert_eq!([fixed(-0.05001, 1), fixed(-10.0, 0), fixed(-0.5, 1)], ["-0.1", "-10", "-0.5"]);
        assert_eq!(fixed(f64::NEG_INFINITY, 1), "-inf");
    }
}
