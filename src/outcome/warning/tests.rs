//! Tests of `warning`.

use super::*;

#[test]
fn a_value_outside_never_looks_like_a_bound() {
    let text = |value, low, high| {
        let (of, quantity) = ("push".to_owned(), Quantity::Speed);
        Warning::OutsideRange { of, quantity, value, low, high }.fact()
    };
    let expected = "push: speed (m/s) = 0.02999 is outside the model's range 0.03 to 0.3";
    assert_eq!(text(0.029_990_1, 0.03, 0.3), expected);
    let expected = "push: speed (m/s) = 20 is outside the model's range 0.03 to 0.3";
    assert_eq!(text(20.0, 0.03, 0.3), expected);
}
