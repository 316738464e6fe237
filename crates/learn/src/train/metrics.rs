//! What a run reports, one JSON line at a time.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Final position errors of rollouts over held-out episodes; objects whose true motion exceeds
/// 1 cm are counted.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HeldOutError {
    /// Step of the weights.
    pub step: u64,
    /// Objects counted.
    pub objects: usize,
    /// Mean, metres.
    pub mean: f64,
    /// Median, metres.
    pub median: f64,
    /// 95th percentile, metres.
    pub p95: f64,
    /// Mean with every error capped at 10 mm, metres: what decides which weights are best,
    /// because a handful of pushes that end differently by chance otherwise would.
    pub capped: f64,
    /// Mean heading error of cuboids, radians.
    pub heading: f64,
    /// The same over episodes with a single object.
    pub single: Option<Box<HeldOutError>>,
    /// The same over episodes with more than three.
    #[serde(default)]
    pub crowd: Option<Box<HeldOutError>>,
}

/// One line of `metrics.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MetricLine {
    /// Steps taken.
    pub step: u64,
    /// Mean one-frame loss since the last line.
    pub loss: f64,
    /// Mean gradient norm before clipping since the last line.
    pub gradient: f64,
    /// Learning rate.
    pub learning_rate: f64,
    /// Graphs trained on per second since the last line.
    pub graphs_per_second: f64,
    /// Wall time of this process so far, seconds.
    pub seconds: f64,
    /// Held-out rollout error of the averaged weights.
    pub held_out: HeldOutError,
}

impl fmt::Display for MetricLine {
    /// What a person wants to follow.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let HeldOutError { mean, median, p95, .. } = self.held_out;
        let [mean, median, p95] = [mean, median, p95].map(|metres| 1e3 * metres);
        write!(
            f,
            "step {:>7}  loss {:.4}  held out: mean {mean:.1} mm, median {median:.1} mm, p95 {p95:.1} mm  \
             {:.0} graphs/s",
            self.step, self.loss, self.graphs_per_second
        )
    }
}
