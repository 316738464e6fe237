//! The `pushplan` command.

fn main() {}
