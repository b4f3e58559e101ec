//! Ants that drive, on the threads of a pool, and their paths in order.

use super::DriveConfig;
use super::ant::Ant;
use super::shared::DriveShared;
use crate::colony::worker_pool::{AntWorker, Batch, Pace};
use crate::numeric::Seed;
use crate::progress::DriveWay;
use crate::search::DriveProblem;
use std::ops::Range;

/// Two kinds of ants: of each pair the first drives forward until its last curve, the second uses
/// both gears.
pub(super) struct DriveWorker<'a> {
    ants: [Ant<'a>; 2],
    seed: Seed,
}

impl<'a> DriveWorker<'a> {
    pub(super) fn new(problem: &DriveProblem<'a>, config: &DriveConfig, seed: Seed) -> Self {
        Self {
            ants: [
                Ant::new(&problem.forward_on_the_way(), config),
                Ant::new(problem, config),
            ],
            seed,
        }
    }
}

/// Paths of some ants, in their order.
#[derive(Default)]
pub(super) struct Ways(pub(super) Vec<DriveWay>);

impl Batch for Ways {
    fn clear(&mut self) {
        self.0.clear();
    }

    fn append(&mut self, ways: &Self) {
        self.0.extend_from_slice(&ways.0);
    }
}

impl<'a> AntWorker for DriveWorker<'a> {
    type Shared = DriveShared<'a>;
    type Batch = Ways;

    const STEPS_PER_LOOK: u32 = 1;

    fn walk_ants(
        &mut self,
        shared: &DriveShared<'a>,
        (generation, ants): (u32, Range<u32>),
        ways: &mut Ways,
        pace: &mut Pace,
    ) {
        for index in ants {
            if pace.is_over() {
                return;
            }
            let mut draw = self.seed.stream([u64::from(generation), u64::from(index)]);
            let start = shared.starts[index as usize / 2 % shared.starts.len()];
            // The first two of a run are the greedy ones.
            let is_greedy = shared.first_wins && index < 2;
            let way =
                self.ants[index as usize % 2].drive(shared, start, (&mut draw, is_greedy), pace);
            let has_arrived = way.died_at.is_none();
            ways.0.push(way);
            // Later ants of this batch cannot win any more.
            if has_arrived && shared.first_wins {
                return;
            }
        }
    }
}
