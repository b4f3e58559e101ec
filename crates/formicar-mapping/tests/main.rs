//! Suites over the public interface.
