//! Addresses of maps in bags: `BAG.mcap[:TOPIC][@TIME]`.

use super::is_bag;
use crate::values;
use anyhow::{Result, anyhow};
use std::path::{Path, PathBuf};

/// A map in a bag.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MapAddress {
    pub(crate) bag: PathBuf,
    /// The only topic of maps by default, or `/map`.
    pub(crate) topic: Option<String>,
    /// Seconds since the first map, or Unix time; the last map by default.
    pub(crate) time_s: Option<f64>,
}

impl MapAddress {
    /// The address that a name is, if it is that of a bag.
    ///
    /// # Errors
    /// A time that is no number.
    pub(crate) fn parse(name: &str) -> Result<Option<Self>> {
        let ends = name.match_indices([':', '@']).map(|(at, _)| at);
        let bag = std::iter::once(name.len()).chain(ends);
        let Some(end) = { bag }.find(|&end| is_bag(Path::new(&name[..end]))) else {
            return Ok(None);
        };
        let (bag, rest) = name.split_at(end);
        let (topic, time) = match rest.split_once('@') {
            Some((topic, time)) => (topic, Some(time)),
            None => (rest, None),
        };
        let topic = topic.trim_start_matches(':');
        let time_s = time.map(|time| {
            values::number(time).map_err(|problem| anyhow!("{name}: the time after @: {problem}"))
        });
        Ok(Some(Self {
            bag: PathBuf::from(bag),
            topic: (!topic.is_empty()).then(|| topic.to_owned()),
            time_s: time_s.transpose()?,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_bags_may_go_on_with_topic_and_time() {
        let parse = |name: &str| MapAddress::parse(name).unwrap();
        let address = |topic: Option<&str>, time_s| {
            Some(MapAddress {
                bag: PathBuf::from("a/b.mcap"),
                topic: topic.map(str::to_owned),
                time_s,
            })
        };
        assert_eq!(parse("a/b.mcap"), address(None, None));
        assert_eq!(parse("a/b.mcap:/map"), address(Some("/map"), None));
        assert_eq!(parse("a/b.mcap:map@2.5"), address(Some("map"), Some(2.5)));
        assert_eq!(parse("a/b.mcap@0"), address(None, Some(0.0)));
        assert_eq!(parse("depot.yaml"), None);
        assert_eq!(parse("c:/depot.yaml"), None);
        let error = MapAddress::parse("b.mcap@noon").unwrap_err().to_string();
        assert!(error.contains("b.mcap@noon: the time after @"), "{error}");
    }
}
