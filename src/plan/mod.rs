//! Candidates, parallel search and QP refinement. Verifies nothing.
