//! The argument of `--push`: a push, given by its start or by the pushed object.

use pushplan::geometry::Vector;
use pushplan::solve::{ManualPush, ManualStart};

/// Help for options that accept a push.
const FORMS: &str = "\
Pushes, in the order of execution:
  --push 'start=0.42,0.10 direction_deg=180 length=0.2 speed=0.1'
      start of the end effector (m), direction (degrees from +x), length (m) and speed (m/s);
      length and speed default to the values of the task
  --push can:180          push the object `can` towards -x; the tool starts next to it
  --push can:180:0.01     with the object's centre 1 cm left of the centre line of the tool's face
  --push can:180:0:0.15   over a length of 15 cm";

/// Returns the help for options that accept pushes or a lever-up.
pub fn forms() -> String {
    format!("{FORMS}\n\n{}", super::lever_argument::LEVER_FORM)
}

/// Parses one push.
///
/// # Errors
/// Returns a description of the fault, with a correction.
pub fn push_argument(text: &str) -> Result<ManualPush, String> {
    if text.contains('=') { keyed(text) } else { colons(text) }
}

fn keyed(text: &str) -> Result<ManualPush, String> {
    let (mut start, mut direction, mut length, mut speed) = (None, None, None, None);
    for word in text.split_whitespace() {
        let Some((key, value)) = word.split_once('=') else {
            return Err(format!("`{word}` is not of the form key=value"));
        };
        let slot = match key {
            "start" => {
                let (x, y) = value.split_once(',').ok_or("start needs two numbers: start=x,y")?;
                let at = Vector::new(number("start", x)?, number("start", y)?);
                if start.replace(at).is_some() {
                    return Err("start is given twice".to_owned());
                }
                continue;
            }
            "direction_deg" => &mut direction,
            "length" => &mut length,
            "speed" => &mut speed,
            _ => {
                return Err(format!(
                    "unknown key `{key}`; use start, direction_deg, length and speed"
                ));
            }
        };
        if slot.replace(number(key, value)?).is_some() {
            return Err(format!("{key} is given twice"));
        }
    }
    let direction: f64 = direction.ok_or("direction_deg is missing")?;
    finish(start.map_or(ManualStart::Last, ManualStart::At), direction, length, speed)
}

fn colons(text: &str) -> Result<ManualPush, String> {
    let mut parts = text.split(':');
    let object = parts.next().unwrap_or_default().trim().to_owned();
    let direction = parts.next().ok_or("use OBJECT:DIRECTION_DEG[:OFFSET[:LENGTH]]")?;
    let direction = number("direction", direction)?;
    let offset = parts.next().map_or(Ok(0.0), |value| number("offset", value))?;
    let length = parts.next().map(|value| number("length", value)).transpose()?;
    if object.is_empty() || parts.next().is_some() {
        return Err("use OBJECT:DIRECTION_DEG[:OFFSET[:LENGTH]]".to_owned());
    }
    finish(ManualStart::Before { object, offset }, direction, length, None)
}

fn finish(
    start: ManualStart,
    direction_deg: f64,
    length: Option<f64>,
    speed: Option<f64>,
) -> Result<ManualPush, String> {
    // Task files have the same ranges.
    for (name, value, largest) in [("length", length, 2.0), ("speed", speed, 2.0)] {
        if value.is_some_and(|value| !(value > 0.0 && value <= largest)) {
            return Err(format!("{name} must be above 0 and at most {largest}"));
        }
    }
    Ok(ManualPush { start, direction: direction_deg.to_radians(), length, speed })
}

fn number(name: &str, text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("{name}: `{text}` is not a finite number")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_are_read() {
        let push = push_argument("start=0.4,-0.1 direction_deg=180 length=0.2").unwrap();
        assert_eq!(push.start, ManualStart::At(Vector::new(0.4, -0.1)));
        assert_eq!(push.direction, std::f64::consts::PI);
        assert_eq!((push.length, push.speed), (Some(0.2), None));
        let push = push_argument("can:-90:0.01").unwrap();
        let before = ManualStart::Before { object: "can".to_owned(), offset: 0.01 };
        assert_eq!((push.start, push.length), (before, None));
    }

    #[test]
    fn mistakes_are_named() {
        let error = |text: &str| push_argument(text).unwrap_err();
        assert_eq!(error("start=0.4,0 length=1"), "direction_deg is missing");
        assert_eq!(error("can:nan"), "direction: `nan` is not a finite number");
        assert_eq!(error("can:0:0:-1"), "length must be above 0 and at most 2");
        assert_eq!(error("start=1,2 start=1,2 direction_deg=0"), "start is given twice");
        assert!(error("start=1,2 way=3").starts_with("unknown key `way`"));
        assert!(error("can").starts_with("use OBJECT:"));
    }
}
