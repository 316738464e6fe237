//! The argument of `--lever`: one lever-up.

use pushplan::solve::{ManualLever, ManualPlace};
use pushplan::task::Pivot;

/// Help for options that accept a lever-up.
pub const LEVER_FORM: &str = "\
Lever-up of a levering task:
  --lever point=0:0.5,depth=0.012,angle=90
      lever point (edge, counted from 0, and fraction along it; or metres along the outline from
      the first corner), depth of the blade (m) and rotation (degrees)
  --lever point=0:0.5,depth=0.012,angle=30,pivot=-0.012,speed=0.05
      with the axis 12 mm behind the edge instead of at the support line (pivot=auto), and with
      a speed of 0.05 m/s (default: the speed of the task)";

/// Parses one lever-up.
///
/// # Errors
/// Returns a description of the fault, with a correction.
pub fn lever_argument(text: &str) -> Result<ManualLever, String> {
    let (mut place, mut pivot) = (None, None);
    let (mut depth, mut angle, mut speed) = (None, None, None);
    for word in text.split([',', ' ']).filter(|word| !word.is_empty()) {
        let Some((key, value)) = word.split_once('=') else {
            return Err(format!("`{word}` is not of the form key=value"));
        };
        let twice = match key {
            "point" => place.replace(point(value)?).is_some(),
            "pivot" => {
                let found = match value {
                    "auto" => Pivot::Auto,
                    _ => Pivot::At(within(key, value, [-0.2, 1.0])?),
                };
                pivot.replace(found).is_some()
            }
            // Task files have the same ranges.
            "depth" => depth.replace(within(key, value, [0.002, 0.2])?).is_some(),
            "angle" => angle.replace(within(key, value, [1.0, 150.0])?).is_some(),
            "speed" => speed.replace(within(key, value, [0.01, 1.0])?).is_some(),
            _ => {
                return Err(format!(
                    "unknown key `{key}`; use point, depth, angle, pivot and speed"
                ));
            }
        };
        if twice {
            return Err(format!("{key} is given twice"));
        }
    }
    Ok(ManualLever {
        place: place.ok_or("point is missing: point=EDGE:FRACTION, or metres along the outline")?,
        depth: depth.ok_or("depth in metres is missing")?,
        angle: angle.ok_or("angle in degrees is missing")?.to_radians(),
        pivot: pivot.unwrap_or(Pivot::Auto),
        speed,
    })
}

fn point(text: &str) -> Result<ManualPlace, String> {
    match text.split_once(':') {
        Some((edge, fraction)) => {
            let edge = edge.parse().map_err(|_| format!("point: `{edge}` is no edge number"))?;
            Ok(ManualPlace::Edge(edge, within("point", fraction, [0.0, 1.0])?))
        }
        None => Ok(ManualPlace::Along(within("point", text, [0.0, 100.0])?)),
    }
}

fn within(key: &str, text: &str, [low, high]: [f64; 2]) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (low..=high).contains(&value) => Ok(value),
        Ok(value) if value.is_finite() => Err(format!("{key} must be from {low} to {high}")),
        _ => Err(format!("{key}: `{text}` is not a finite number")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_of_a_position_are_read() {
        let lever = lever_argument("point=0:0.5,depth=0.012,angle=90").unwrap();
        assert_eq!((lever.place, lever.pivot), (ManualPlace::Edge(0, 0.5), Pivot::Auto));
        assert_eq!((lever.depth, lever.angle), (0.012, std::f64::consts::FRAC_PI_2));
        let lever = lever_argument("point=0.13 depth=0.012 angle=30 pivot=-0.012").unwrap();
        assert_eq!((lever.place, lever.pivot), (ManualPlace::Along(0.13), Pivot::At(-0.012)));
    }

    #[test]
    fn mistakes_are_named() {
        let error = |text: &str| lever_argument(text).unwrap_err();
        assert_eq!(error("point=0:0.5,angle=90"), "depth in metres is missing");
        assert_eq!(error("point=0:2,depth=0.01,angle=9"), "point must be from 0 to 1");
        assert_eq!(error("depth=nan"), "depth: `nan` is not a finite number");
        assert_eq!(error("depth=12"), "depth must be from 0.002 to 0.2");
        assert_eq!(error("angle=5,angle=6"), "angle is given twice");
        assert!(error("way=3").starts_with("unknown key `way`"));
        assert!(error("90").contains("key=value"));
    }
}
