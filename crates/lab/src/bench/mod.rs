//! Suites, baselines, statistics and timings behind the published numbers.
//!
//! Everything is seeded, takes any [`pushplan::EffectModel`] and returns plain data that can be
//! written as JSON; nothing is rendered here.

mod adapted;
mod answers;
mod baselines;
mod belief;
mod calibration;
mod closed;
mod cpu_clock;
mod crowd;
mod equations;
mod evaluation;
mod far;
mod heldout;
mod inference;
mod lever;
mod masses;
mod probes;
mod random;
mod refinement;
mod suite;
mod timing;
mod tradeoff;

pub use adapted::{AdaptedPush, AdaptedRow, Ratio, Split, adapted_rows, measure_split, splits};
pub use answers::{AnswerError, Answers};
pub use baselines::{crowd_baselines, push_baselines};
pub use belief::{
    Asked, BeliefCase, BeliefRecord, BeliefStep, BeliefSuite, BeliefSummary, Checkpoint,
    Circumstances, JointMethod, Rest, RestOfWay, Right, Sighting, Sure, UpdateTimes, When,
    belief_steps, follow, summarise_beliefs, update_times,
};
pub use calibration::Calibration;
pub use closed::{ClosedRecord, Left};
pub use crowd::{CrowdFamily, CrowdReport, CrowdSet};
pub use equations::{EquationCost, equation_costs};
pub use evaluation::{Evaluated, by_kind};
pub use far::{FAR_COUNTS, FarCost, far_costs};
pub use heldout::{ErrorRow, HeldOut, HeldOutErrors, HeldOutReport, PERTURBATION};
pub use inference::{InferenceCost, inference_costs};
pub use lever::{
    ConvergenceReport, ConvergenceRow, DriveReport, DriveRow, LeverBaseline, LeverRecord,
    LeverReport, LeverRow, LeverSuite, Neighbour, PointReport, PointRow, Setting, SupportRow,
    convergence, drive_report, lever_report, load_lever, point_report, support_rows,
};
pub use masses::{
    MassCase, MassRecord, MassSuite, MassSummary, SeenMass, SeenRatio, summarise_masses,
};
pub use probes::{Learnt, ProbeCase, ProbeRecord, ProbeSuite, ProbeSummary, summarise_probes};
pub use random::{
    Choice, HiddenTask, HiddenWorld, Maker, NoTask, RandomError, RandomRecord, RandomSuite,
    SuiteTask, TaskKind, random_task,
};
pub use refinement::{PlanErrors, RefinedTask, RefinementReport, Tried, refine_task};
pub use suite::{Case, Suite, SuiteKind, crowd_cases};
pub use timing::{PushCost, SearchCost, push_costs, search_costs};
pub use tradeoff::{
    Level, Noise, ObjectCost, PlanLevel, PlanRow, Point, PredictorRow, SuiteErrors, TradeOff,
    TradeOffReport, TradeOffSettings, Unit, dominates, is_open, levels, on_front, plan_levels,
    prior_instead,
};
