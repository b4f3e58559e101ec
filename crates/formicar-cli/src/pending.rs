//! Stand-ins for map files and built-in maps, until the library brings them.

pub(crate) mod builtin {
    //! One map.
    use anyhow::{Result, bail};
    use formicar::geometry::Pose2;
    use formicar::map::OccupancyGrid;

    pub(crate) struct BuiltinRequest {
        pub(crate) id: &'static str,
        pub(crate) start: Pose2,
        pub(crate) goal: Pose2,
    }

    pub(crate) struct BuiltinMap {
        pub(crate) name: &'static str,
        pub(crate) about: &'static str,
        pub(crate) vehicle: &'static str,
        pub(crate) requests: &'static [BuiltinRequest],
    }

    impl BuiltinMap {
        pub(crate) fn by_name(name: &str) -> Result<&'static Self> {
            match all().iter().find(|map| map.name == name) {
                Some(map) => Ok(map),
                None => bail!("no built-in map is named {name:?}; there are open"),
            }
        }

        pub(crate) fn request(&self, id: &str) -> Result<&'static BuiltinRequest> {
            match self.requests.iter().find(|request| request.id == id) {
                Some(request) => Ok(request),
                None => bail!("built-in map {} has no request {id:?}", self.name),
            }
        }

        pub(crate) fn grid(&self) -> OccupancyGrid {
            OccupancyGrid::from_rows(&["........................"; 16], 0.5)
                .expect("the rows are rectangular")
        }
    }

    pub(crate) fn all() -> &'static [BuiltinMap] {
        const REQUESTS: [BuiltinRequest; 1] = [BuiltinRequest {
            id: "across",
            start: Pose2::new(2.0, 2.0, 0.0),
            goal: Pose2::new(9.0, 5.0, 1.0),
        }];
        &[BuiltinMap {
            name: "open",
            about: "nothing in the way",
            vehicle: "warehouse_amr",
            requests: &REQUESTS,
        }]
    }
}

pub(crate) mod format {
    //! Writing and reading.
    use std::path::Path;

    pub(crate) fn write_atomically(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
        std::fs::write(path, bytes)
    }
}
