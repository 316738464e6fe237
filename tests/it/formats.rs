//! Other formats: exported files are read back, and foreign files are imported or refused with a
//! reason. Python tests check exported files with MuJoCo, `mcap` and NumPy.

mod advice;
mod attributes;
mod costs;
mod dialects;
mod imports;
mod kinds;
mod meshes;
mod reported;
mod round_trip;
