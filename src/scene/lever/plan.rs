//! A lever-up and the tool that makes it, and perhaps pushes that follow.

use serde::{Deserialize, Serialize};

use super::{FollowUp, LeverUp};

/// A lever-up and the tool that makes it, and perhaps pushes that follow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverPlan {
    /// Name of the tool.
    pub tool: String,
    /// The lever-up.
    pub lever: LeverUp,
    /// The pushes that follow. Plan files hold them beside the plan, with their tool.
    #[serde(skip)]
    pub follow_up: Option<FollowUp>,
}
