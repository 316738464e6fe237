//! One file per subcommand; holds no logic of the field.
