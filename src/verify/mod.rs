//! Replays tool motions in the simulator and gives a verdict with evidence. Knows nothing of planning.
