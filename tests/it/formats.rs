//! Other formats: exported files are read back, and foreign files are imported or refused with a
//! reason. Python tests check exported files with MuJoCo, `mcap` and NumPy.

mod advice;
mod costs;
mod imports;
mod kinds;
mod meshes;
mod round_trip;
