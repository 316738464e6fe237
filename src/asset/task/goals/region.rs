//! Goals in a region.

use serde_json::json;

use crate::asset::put::posed;
use crate::asset::spec::{Key, Value};
use crate::asset::task::keep::{
    AREA, AREA_POSITION, AREA_YAW, area, check_area, emitted_area as area_of,
};
use crate::task::{Area, Demand, InArea};

use super::ask::{About, Ask};

/// An area for the centre.
pub(super) const REGION: Ask = Ask {
    keys: &[Key::optional(
        "region",
        Value::Map(&[AREA, AREA_POSITION, AREA_YAW]),
        "Where its centre may lie instead, a circle, rectangle or polygon; by default nowhere in \
         particular.",
    )],
    about: About::Place,
    read: |goal, _, _| {
        let (shape, pose) = area(goal.get("region")?)?;
        Some(Demand::Area(Box::new(InArea::new(Area { shape, pose }))))
    },
    write: |demand, _, _| {
        let Demand::Area(own) = demand else { return None };
        let (shape, pose) = (&own.area.shape, &own.area.pose);
        Some(json!({"region": posed(json!({"area": area_of(shape)}), pose)}))
    },
    check: |asked, ledger| {
        if let Some(region) = asked.goal.get("region") {
            check_area(region, ledger);
        }
    },
};
