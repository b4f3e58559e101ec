//! Files of other planners.
