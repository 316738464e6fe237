//! Goals inside or outside a region.

use serde_json::json;

use crate::asset::put::posed;
use crate::asset::spec::{Key, Value};
use crate::asset::task::keep::{
    AREA, AREA_POSITION, AREA_YAW, area, check_area, emitted_area as area_of,
};
use crate::task::demand::{Area, Demand, InArea, OutOfArea};

use super::ask::{About, Ask};

const OUTSIDE: Key = Key::optional(
    "outside",
    Value::Switch,
    "Whether the centre must lie outside the region instead; default false.",
);

/// Entry for a region that must contain the centre, or exclude it.
pub(super) const REGION: Ask = Ask {
    keys: &[Key::optional(
        "region",
        Value::Map(&[AREA, AREA_POSITION, AREA_YAW, OUTSIDE]),
        "Region in which its centre must lie instead: a circle, rectangle or polygon; by default \
         any.",
    )],
    about: About::Place,
    read: |goal, _, _| {
        let region = goal.get("region")?;
        let (shape, pose) = area(region)?;
        let area = Area { shape, pose };
        Some(match region.get("outside").map_or(Some(false), |node| node.switch())? {
            false => Demand::Area(Box::new(InArea::new(area))),
            true => Demand::OutOf(Box::new(OutOfArea::new(area))),
        })
    },
    write: |demand, _, _| {
        let (Area { shape, pose }, outside) = match demand {
            Demand::Area(own) => (&own.area, false),
            Demand::OutOf(own) => (&own.area, true),
            _ => return None,
        };
        let mut region = posed(json!({"area": area_of(shape)}), pose);
        if outside {
            region["outside"] = json!(true);
        }
        Some(json!({"region": region}))
    },
    check: |asked, ledger| {
        if let Some(region) = asked.goal.get("region") {
            check_area(region, ledger);
        }
    },
};
