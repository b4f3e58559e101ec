//! Parameters: one declaration of each gives its default, its check, its schema and its
//! documentation.
//!
//! Configurations are declared by the crate's `parameters!` and `rules!`, which write the plain
//! structs and enums that users see.

mod checked;
mod declare;
#[cfg(feature = "schema")]
mod list;
mod range;
#[cfg(feature = "schema")]
mod schema;
mod unit;

pub use checked::Parameters;
pub(crate) use declare::{parameters, rules};
#[cfg(feature = "schema")]
pub use list::{Kind, Parameter, list};
pub use range::{Number, OutOfRange, Range, Ranged};

#[cfg(feature = "schema")]
pub(crate) use schema::describe;
pub use unit::unit_of;
