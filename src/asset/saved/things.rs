//! Compound objects as in a task file.

use serde_json::{Value as Json, json};

use crate::asset::put::{drawn, posed, shape};
use crate::asset::task::{emitted_support, shares_of_mass};
use crate::scene::{Object, Scene, Whole};

/// Returns the mass of object `index` including its parts, kg, and the parts. For a single solid,
/// returns its own mass and no parts.
pub(super) fn parts(scene: &Scene, index: usize) -> (f64, Vec<Json>) {
    let parts: Vec<&Object> = scene.parts_of(index).map(|k| &scene.objects[k]).collect();
    let own = &scene.objects[index];
    if parts.is_empty() {
        return (own.mass, Vec::new());
    }
    let solids: Vec<Object> = std::iter::once(own).chain(parts.iter().copied()).cloned().collect();
    let whole = by_volume(&solids);
    let part = |(k, part): (usize, &&Object)| {
        let place = part.whole.map_or_else(Default::default, |Whole { place, .. }| place);
        let solid = if own.in_space() { drawn(&part.shape) } else { shape(&part.shape) };
        let mut fields = json!({"shape": solid, "friction": part.friction});
        if part.is_raised() || own.in_space() {
            fields["z"] = json!(part.z);
        }
        if !part.is_raised() {
            fields["support"] = emitted_support(&part.support);
        }
        // A part without a name is named by its number.
        let name = part.name.strip_prefix(&format!("{}/", own.name)).unwrap_or(&part.name);
        if name != (k + 1).to_string() {
            fields["name"] = json!(name);
        }
        if whole.is_none() {
            fields["mass"] = json!(part.mass);
        }
        posed(fields, &place)
    };
    let all = solids.iter().map(|solid| solid.mass).sum();
    (whole.unwrap_or(all), parts.iter().enumerate().map(part).collect())
}

/// Returns the total mass, kg, if its shares by volume equal the masses of the solids bit for bit.
fn by_volume(solids: &[Object]) -> Option<f64> {
    let sum: f64 = solids.iter().map(|solid| solid.mass).sum();
    let open = vec![None; solids.len()];
    let round = (sum * 1e9).round() / 1e9;
    let mut candidates = vec![round, sum];
    let (mut up, mut down) = (sum, sum);
    for _ in 0..4 {
        (up, down) = (up.next_up(), down.next_down());
        candidates.extend([up, down]);
    }
    let fits = |mass: &f64| {
        let shares = shares_of_mass(*mass, solids, &open);
        solids.iter().zip(shares).all(|(solid, share)| solid.mass == share)
    };
    candidates.into_iter().find(fits)
}
