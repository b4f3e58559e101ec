//! validation: to come.
