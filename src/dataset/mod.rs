//! Sampling scenes and pushes, generating shards of trajectories. Trains nothing.
