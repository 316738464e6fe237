//! Quantities with units, formatted concisely.

use pushplan::decimals::fixed;

/// Formats a length given in metres, in millimetres.
pub fn millimetres(metres: f64) -> String {
    let value = metres * 1e3;
    if !value.is_finite() {
        "not finite".to_owned()
    } else if value.abs() < 99.95 {
        format!("{} mm", fixed(value, 1))
    } else {
        format!("{} mm", fixed(value, 0))
    }
}

/// Formats a length as [`millimetres`] does, with two decimals below a centimetre, where a tenth of
/// a millimetre is a few per cent.
pub fn fine_millimetres(metres: f64) -> String {
    if metres.abs() < 0.00995 {
        format!("{} mm", fixed(metres * 1e3, 2))
    } else {
        millimetres(metres)
    }
}

/// Formats an angle given in radians, in degrees.
pub fn degrees(radians: f64) -> String {
    let value = radians.to_degrees();
    if value.is_finite() { format!("{}\u{00b0}", fixed(value, 1)) } else { "not finite".to_owned() }
}

/// Formats a duration given in seconds, in the unit that leaves two to four digits.
pub fn seconds(seconds: f64) -> String {
    match seconds {
        s if !s.is_finite() => "not finite".to_owned(),
        s if s < 1e-5 => format!("{:.2} \u{00b5}s", s * 1e6),
        s if s < 1e-3 => format!("{:.0} \u{00b5}s", s * 1e6),
        s if s < 0.1 => format!("{:.1} ms", s * 1e3),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s if s < 120.0 => format!("{s:.2} s"),
        s if s < 7200.0 => format!("{:.1} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_follow_the_size() {
        assert_eq!(millimetres(0.00312), "3.1 mm");
        assert_eq!(millimetres(0.4127), "413 mm");
        assert_eq!(millimetres(f64::NAN), "not finite");
        assert_eq!(fine_millimetres(0.00312), "3.12 mm");
        assert_eq!(fine_millimetres(0.4127), "413 mm");
        assert_eq!(fine_millimetres(f64::NAN), "not finite");
        assert_eq!(degrees(std::f64::consts::FRAC_PI_2), "90.0\u{00b0}");
        assert_eq!([millimetres(-1e-6), degrees(-1e-6)], ["0.0 mm", "0.0\u{00b0}"]);
        assert_eq!(fine_millimetres(-0.0), "0.00 mm");
        assert_eq!(seconds(0.0123), "12.3 ms");
        assert_eq!(seconds(5400.0), "90.0 min");
    }
}
