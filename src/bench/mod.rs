//! Suites, baselines, statistics, held-out evaluation. Draws nothing.
