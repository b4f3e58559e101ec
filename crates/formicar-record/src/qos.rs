//! Qualities of service, as rosbag2 keeps them beside a topic.

/// How long a publisher keeps its messages for those who come late.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Durability {
    /// It does not.
    Volatile,
    /// The last message reaches late subscribers: maps and static transforms.
    Latched,
}

impl Durability {
    /// `offered_qos_profiles` in the form that players of all distributions read: reliable, the
    /// policies as the numbers of rmw, times without limit.
    pub(crate) fn profiles(self) -> String {
        let (depth, durability) = match self {
            Self::Volatile => (10, 2),
            Self::Latched => (1, 1),
        };
        let forever = "    sec: 9223372036\n    nsec: 854775807\n";
        format!(
            "- history: 1\n  depth: {depth}\n  reliability: 1\n  durability: {durability}\n  \
             deadline:\n{forever}  lifespan:\n{forever}  liveliness: 1\n  \
             liveliness_lease_duration:\n{forever}  avoid_ros_namespace_conventions: false\n"
        )
    }
}
