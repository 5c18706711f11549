//! Big float.
