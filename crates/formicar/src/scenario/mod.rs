//! scenario: to come.
