//! rapier behind one door, in two engines: planar (default truth) and 3-D (independent check). Plans nothing.
