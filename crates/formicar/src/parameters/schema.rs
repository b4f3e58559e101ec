//! Range and unit of a parameter in its JSON schema.

use super::range::Range;
use super::unit::unit_of;
use schemars::Schema;
use serde_json::{Map, Value};
use std::ops::Bound;

/// The key of a parameter's unit in its schema.
pub(super) const UNIT: &str = "x-unit";

/// Writes range and unit of a field into the schema of its struct.
pub(crate) fn describe(schema: &mut Schema, field: &str, range: Range) {
    // A field that documents do not have is none of the properties.
    let Some(Value::Object(property)) = schema.pointer_mut(&format!("/properties/{field}")) else {
        return;
    };
    if let Some(unit) = unit_of(field) {
        property.insert(UNIT.to_owned(), unit.into());
    }
    match property.get_mut("items") {
        Some(Value::Object(items)) => write(items, range),
        _ => write(property, range),
    }
}

fn write(schema: &mut Map<String, Value>, range: Range) {
    let is_integer = match schema.get("type") {
        Some(Value::Array(types)) => types.iter().any(|of| of == "integer"),
        of => of.is_some_and(|of| of == "integer"),
    };
    let bounds = [
        (range.low, "minimum", "exclusiveMinimum"),
        (range.high, "maximum", "exclusiveMaximum"),
    ];
    for (bound, closed, open) in bounds {
        schema.remove(closed);
        let (key, number) = match bound {
            Bound::Included(number) => (closed, number),
            Bound::Excluded(number) => (open, number),
            Bound::Unbounded => continue,
        };
        let number = if is_integer {
            Value::from(number as i64)
        } else {
            Value::from(number)
        };
        schema.insert(key.to_owned(), number);
    }
}

/// The range that a schema tells; none where it bounds nothing.
pub(super) fn range_in(schema: &Value) -> Option<Range> {
    let bound = |closed: &str, open: &str| {
        let number = |key: &str| schema[key].as_f64();
        let included = number(closed).map(Bound::Included);
        included.or(number(open).map(Bound::Excluded))
    };
    let low = bound("minimum", "exclusiveMinimum");
    let high = bound("maximum", "exclusiveMaximum");
    let is_bounded = low.is_some() || high.is_some();
    is_bounded.then(|| Range {
        low: low.unwrap_or(Bound::Unbounded),
        high: high.unwrap_or(Bound::Unbounded),
    })
}
