//! Units, which the names of parameters end with.

/// Endings of names and their units; of two that fit, the longer one stands first.
const UNITS: [(&str, &str); 15] = [
    ("_rad_per_s", "rad/s"),
    ("_m_per_n", "m/N"),
    ("_per_m2", "1/m\u{b2}"),
    ("_per_m", "1/m"),
    ("_per_s", "1/s"),
    ("_mps2", "m/s\u{b2}"),
    ("_mps", "m/s"),
    ("_rad", "rad"),
    ("_deg", "\u{b0}"),
    ("_ms", "ms"),
    ("_kg", "kg"),
    ("_cells", "cells"),
    ("_radii", "turning radii"),
    ("_s", "s"),
    ("_m", "m"),
];

/// The unit of a parameter by its name; none of a pure number.
pub fn unit_of(name: &str) -> Option<&'static str> {
    let unit = UNITS.into_iter().find(|(ending, _)| name.ends_with(ending));
    unit.map(|(_, unit)| unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_end_with_their_unit() {
        assert_eq!(unit_of("max_steer_rate_rad_per_s"), Some("rad/s"));
        assert_eq!(unit_of("curvature_per_m"), Some("1/m"));
        assert_eq!(unit_of("clearance_wish_m"), Some("m"));
        assert_eq!(unit_of("weight"), None);
    }
}
