//! The state that all clients share.

use crate::maps::MapStore;
use crate::options::Options;
use crate::planner_cache::PlannerCache;
use std::sync::Arc;
use tokio::sync::Semaphore;

/// The state that all clients share.
pub(crate) struct Studio {
    pub(crate) options: Options,
    pub(crate) maps: MapStore,
    pub(crate) planners: PlannerCache,
    /// A permit for every client that may be connected.
    pub(crate) clients: Arc<Semaphore>,
    /// A permit for every plan that may be made at a time.
    pub(crate) plans: Semaphore,
}

impl Studio {
    pub(crate) fn new(options: Options) -> Self {
        let permits = |n: usize| Semaphore::new(n.min(Semaphore::MAX_PERMITS));
        Self {
            maps: MapStore::new(options.limits),
            planners: PlannerCache::default(),
            clients: Arc::new(permits(options.limits.max_clients)),
            plans: permits(options.limits.max_plans.max(1)),
            options,
        }
    }
}
