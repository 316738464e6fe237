//! Accuracy of the support edge in closed form, against the edge that a plate stands on.

use pushplan::internals::geometry::Vector3;
use pushplan_learn::dataset::LeverEpisode;
use serde::{Deserialize, Serialize};

/// Frame whose lowest corners count: by then the plate is up, and rarely past an edge.
const FRAME: usize = 1;

/// Plates with a number of corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SupportRow {
    /// Number of corners; 0 for all plates.
    pub corners: usize,
    /// Number of lever-ups.
    pub all: usize,
    /// Number of lever-ups with the right edge.
    pub right: usize,
    /// Number of lever-ups that do not slip.
    pub kept: usize,
    /// Number of lever-ups that do not slip, with the right edge.
    pub kept_right: usize,
}

/// Returns a row for all plates, then a row for each number of corners.
pub fn support_rows(episodes: &[LeverEpisode]) -> Vec<SupportRow> {
    let mut rows = vec![SupportRow::default()];
    for episode in episodes {
        let (corners, right) = (count(episode), is_right(episode));
        if !rows.iter().any(|row| row.corners == corners) {
            rows.push(SupportRow { corners, ..SupportRow::default() });
        }
        let kept = !episode.trajectory.slipped();
        for row in rows.iter_mut().filter(|row| row.corners == 0 || row.corners == corners) {
            row.all += 1;
            row.right += usize::from(right);
            row.kept += usize::from(kept);
            row.kept_right += usize::from(kept && right);
        }
    }
    rows.sort_by_key(|row| row.corners);
    rows
}

fn count(episode: &LeverEpisode) -> usize {
    episode.scene.plates[episode.lever.plate].corners().len()
}

/// Returns `true` if the two lowest corners are the corners of the support edge.
fn is_right(episode: &LeverEpisode) -> bool {
    let plate = &episode.scene.plates[episode.lever.plate];
    let Some(edge) = episode.job().support() else { return false };
    let Some(pose) = episode.trajectory.lift.get(FRAME) else { return false };
    let count = plate.corners().len();
    let height =
        |k: usize| pose.point(Vector3::new(plate.corners()[k].x, plate.corners()[k].y, 0.0)).z;
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| height(*a).total_cmp(&height(*b)));
    let pair = [edge, (edge + 1) % count];
    order[..2].iter().all(|corner| pair.contains(corner))
}
