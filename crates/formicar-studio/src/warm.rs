//! Planners that have planned before: what they have prepared is shared by all visitors.

use crate::ground::Ground;
use crate::maps::OpenMap;
use formicar::planner::{PlanError, Planner, PlannerConfig};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Planners kept.
const MAX_KEPT: usize = 8;

/// Planners on maps that nobody has painted on, the latest last.
#[derive(Debug, Default)]
pub(crate) struct WarmShelf(Mutex<VecDeque<Kept>>);

/// A planner, and what it was made for.
#[derive(Debug)]
struct Kept {
    map: Arc<OpenMap>,
    vehicle: u128,
    planner: Planner,
}

impl Kept {
    fn is_for(&self, ground: &Ground, config: &PlannerConfig) -> bool {
        Arc::ptr_eq(&self.map, &ground.opened)
            && self.vehicle == ground.vehicle.hash()
            && self.planner.vehicle().motion() == ground.vehicle.motion()
            && *self.planner.config() == *config
    }
}

impl WarmShelf {
    /// A planner for a ground: a copy of a kept one, or a new one.
    ///
    /// # Errors
    /// A configuration outside its ranges.
    pub(crate) fn planner(
        &self,
        ground: &Ground,
        config: PlannerConfig,
    ) -> Result<Planner, PlanError> {
        let is_kept = |kept: &&Kept| !ground.is_edited && kept.is_for(ground, &config);
        let kept = self
            .lock()
            .iter()
            .find(is_kept)
            .map(|kept| kept.planner.clone());
        if let Some(planner) = kept {
            return Ok(planner);
        }
        let (obstacles, vehicle) = (ground.obstacles.clone(), ground.vehicle.clone());
        Planner::on(obstacles, vehicle, config)
    }

    /// Keeps a planner that has planned, unless one like it is kept already or the map was
    /// painted on.
    pub(crate) fn keep(&self, ground: &Ground, planner: &Planner) {
        let mut kept = self.lock();
        let is_like_it = |kept: &Kept| kept.is_for(ground, planner.config());
        if ground.is_edited || kept.iter().any(is_like_it) {
            return;
        }
        if kept.len() >= MAX_KEPT {
            kept.pop_front();
        }
        kept.push_back(Kept {
            map: ground.opened.clone(),
            vehicle: ground.vehicle.hash(),
            planner: planner.clone(),
        });
    }

    fn lock(&self) -> MutexGuard<'_, VecDeque<Kept>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
