//! Reading and writing user files: tools, tasks, plans, trajectories. Strict, with source positions; simulates nothing.
