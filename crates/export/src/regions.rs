//! Keep-out regions, which are visible but do not collide.

use pushplan::geometry::Shape;
use pushplan::scene::{Region, Scene};

use super::xml::{Xml, numbers};

/// Thickness of the drawn regions, metres.
const THICK: f64 = 1e-3;

/// Transparent red.
const COLOUR: [f64; 4] = [0.8, 0.2, 0.2, 0.25];

/// Returns the solids of the regions with their names.
pub(super) fn solids(scene: &Scene) -> impl Iterator<Item = (String, Shape)> {
    scene.keep_out.iter().map(|region| (name(region), region.sheet(THICK)))
}

/// Writes a geom for each region. The geoms do not collide: `contype` and `conaffinity` are 0 by
/// default in the file, and no pair names them.
pub(super) fn geoms(xml: &mut Xml, scene: &Scene) {
    for region in &scene.keep_out {
        let name = name(region);
        let (kind, (key, value)) = match region.sheet(THICK) {
            Shape::Cylinder { radius, height } => {
                ("cylinder", ("size", numbers(&[radius, height / 2.0])))
            }
            Shape::Cuboid { size } => ("box", ("size", numbers(&size.map(|extent| extent / 2.0)))),
            Shape::Prism { .. } => ("mesh", ("mesh", name.clone())),
        };
        let at = region.pose.position;
        let attributes = [
            ("name", name),
            ("type", kind.into()),
            (key, value),
            ("pos", numbers(&[at.x, at.y, THICK / 2.0])),
            ("euler", numbers(&[0.0, 0.0, region.pose.heading])),
            ("mass", "0".into()),
            ("rgba", numbers(&COLOUR)),
        ];
        xml.leaf("geom", &attributes);
    }
}

fn name(region: &Region) -> String {
    format!("region/{}", region.name)
}
