//! Files of other programs: what we write we read back, and what others write becomes ours or a fault
//! that says why not. What MuJoCo, `mcap` and NumPy make of ours is tested from Python.

mod advice;
mod imports;
mod kinds;
mod meshes;
mod recordings;
mod round_trip;
