//! Maps that come with the library: grid problems, scenes, and narrow places.

mod catalog;
mod entry;
mod narrow;
mod scenes;

pub use entry::{BuiltinError, BuiltinKind, BuiltinMap, BuiltinRequest};

impl BuiltinMap {
    /// A built-in map by name.
    ///
    /// # Errors
    /// A name that no built-in map has; the message lists all names.
    pub fn by_name(name: &str) -> Result<&'static Self, BuiltinError> {
        let name_matches = |map: &&Self| map.name == name;
        all()
            .iter()
            .find(name_matches)
            .ok_or_else(|| BuiltinError::UnknownMap {
                name: name.to_owned(),
                choices: names(),
            })
    }
}

/// All built-in maps: grid problems, scenes, then the narrow set.
pub fn all() -> &'static [BuiltinMap] {
    &catalog::MAPS
}

fn names() -> Vec<&'static str> {
    all().iter().map(|map| map.name).collect()
}

#[cfg(test)]
mod tests;
