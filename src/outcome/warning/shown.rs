//! Selection and order of the warnings that are shown.

use super::Warning;
use super::words::out_of_range;
use crate::scene::Quantity;

/// Number of warnings shown unless all are requested.
pub const SHOWN_WARNINGS: usize = 3;

/// Returns the texts of warnings, most useful first. Warnings that a quantity is out of range make
/// one line for each quantity, with all its bodies.
pub fn warning_lines(warnings: &[Warning]) -> Vec<String> {
    let mut order: Vec<&Warning> = warnings.iter().collect();
    order.sort_by_key(|warning| usefulness(warning));
    let mut lines = Vec::new();
    let mut quantities: Vec<Quantity> = Vec::new();
    for warning in order {
        match warning {
            Warning::OutsideRange { quantity, .. } if quantities.contains(quantity) => {}
            Warning::OutsideRange { quantity, .. } => {
                quantities.push(*quantity);
                lines.push(out_of_range(warnings.iter().filter(|other| other.is_like(warning))));
            }
            other => lines.push(other.to_string()),
        }
    }
    lines.dedup();
    lines
}

/// Returns the rank of a warning; lower ranks are more useful. An invalid outcome is first, then a
/// measured consequence, then facts that a user can change, then doubts about the model.
fn usefulness(warning: &Warning) -> usize {
    match warning {
        warning if warning.forbids_success() => 0,
        Warning::HardPush { .. }
        | Warning::Squeezed { .. }
        | Warning::NearEdge { .. }
        | Warning::Fell { .. }
        | Warning::Slipped { .. } => 1,
        Warning::Differs { .. } => 2,
        Warning::Guessed { .. } => 3,
        Warning::Doubtful { .. } => 4,
        Warning::Pressed { .. } | Warning::Overlap { .. } | Warning::LooseJoint { .. } => 5,
        Warning::Declined { .. } => 6,
        _ => 7,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measured_consequences_come_first_and_a_quantity_has_one_line() {
        let outside = |of: &str, quantity, value| Warning::OutsideRange {
            of: of.to_owned(),
            quantity,
            value,
            low: 0.01,
            high: 0.15,
        };
        let all = [
            outside("vase", Quantity::Height, 0.22),
            outside("scene", Quantity::Objects, 9.0),
            outside("cup", Quantity::Height, 0.3),
            Warning::Differs { object: "vase".into(), distance: 0.06 },
            Warning::NotFinite,
        ];
        let lines = warning_lines(&all);
        assert_eq!(lines.len(), 4);
        assert_eq!(lines[0], Warning::NotFinite.to_string());
        assert_eq!(lines[1], all[3].to_string());
        let height = "height (m) of vase = 0.22 and of cup = 0.3 is outside the model's range 0.01 \
                      to 0.15";
        assert!(lines[2].starts_with(height), "{}", lines[2]);
        // A single one reads as before.
        assert_eq!(lines[3], all[1].to_string());
    }
}
