//! The planner: search, refine, verify in batches, and the status of the result.
