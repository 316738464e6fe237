//! Losses, optimiser, schedule, checkpoints and resumption. Generates no data.
