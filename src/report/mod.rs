//! JSON, tables, SVG. Computes nothing.
