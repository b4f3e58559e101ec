//! A cache of prepared planners, shared by all clients.

use crate::maps::OpenMap;
use crate::scene::Scene;
use formicar::planner::{PlanError, Planner, PlannerConfig};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The most planners that are kept.
const MAX_KEPT: usize = 8;

/// Planners on unedited maps, the latest last.
#[derive(Debug, Default)]
pub(crate) struct PlannerCache(Mutex<VecDeque<Kept>>);

/// A planner, with the map and vehicle that it was made for.
#[derive(Debug)]
struct Kept {
    map: Arc<OpenMap>,
    vehicle: u128,
    planner: Planner,
}

impl Kept {
    fn is_for(&self, scene: &Scene, config: &PlannerConfig) -> bool {
        Arc::ptr_eq(&self.map, &scene.opened)
            && self.vehicle == scene.vehicle.hash()
            && self.planner.vehicle().motion() == scene.vehicle.motion()
            && self.planner.config() == Some(config)
    }
}

impl PlannerCache {
    /// A planner for a scene: a copy of a kept one, or a new one.
    ///
    /// # Errors
    /// A configuration outside its ranges.
    pub(crate) fn planner(
        &self,
        scene: &Scene,
        config: PlannerConfig,
    ) -> Result<Planner, PlanError> {
        let is_kept = |kept: &&Kept| !scene.is_edited && kept.is_for(scene, &config);
        let kept = self
            .lock()
            .iter()
            .find(is_kept)
            .map(|kept| kept.planner.clone());
        if let Some(planner) = kept {
            return Ok(planner);
        }
        let (obstacles, vehicle) = (scene.obstacles.clone(), scene.vehicle.clone());
        Planner::on(obstacles, vehicle, config)
    }

    /// Keeps a planner that has planned, unless an equal one is kept already or the map was
    /// edited.
    pub(crate) fn keep(&self, scene: &Scene, planner: &Planner) {
        let mut kept = self.lock();
        let config = planner.config();
        let is_equal = |kept: &Kept| config.is_some_and(|config| kept.is_for(scene, config));
        if scene.is_edited || kept.iter().any(is_equal) {
            return;
        }
        if kept.len() >= MAX_KEPT {
            kept.pop_front();
        }
        kept.push_back(Kept {
            map: scene.opened.clone(),
            vehicle: scene.vehicle.hash(),
            planner: planner.clone(),
        });
    }

    fn lock(&self) -> MutexGuard<'_, VecDeque<Kept>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
