//! Ants on the threads of a crew, and their ways in their order.

use super::DriveConfig;
use super::ant::Ant;
use super::trails::Trails;
use crate::colony::crew::{Part, Walk};
use crate::numeric::Seed;
use crate::progress::DriveWay;
use crate::search::{DriveProblem, Guide, State};
use std::ops::Range;

/// What the ants of a generation read.
pub(super) struct Ground<'a> {
    pub(super) guide: Guide<'a>,
    pub(super) trails: Trails,
    /// Where the ants begin: ant i at number i, around and around.
    pub(super) starts: Vec<State>,
    /// Whether ants turn home when another has arrived.
    pub(super) first_wins: bool,
}

/// Two kinds of ants: of each pair the first drives forward until its last curve, the second uses
/// both gears.
pub(super) struct Walker<'a> {
    ants: [Ant<'a>; 2],
    seed: Seed,
}

impl<'a> Walker<'a> {
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

/// Ways of some ants, in their order.
#[derive(Default)]
pub(super) struct Ways(pub(super) Vec<DriveWay>);

impl Part for Ways {
    fn clear(&mut self) {
        self.0.clear();
    }

    fn append(&mut self, part: &Self) {
        self.0.extend_from_slice(&part.0);
    }
}

impl<'a> Walk for Walker<'a> {
    type Shared = Ground<'a>;
    type Part = Ways;

    fn send(&mut self, ground: &Ground<'a>, generation: u32, ants: Range<u32>, part: &mut Ways) {
        for index in ants {
            let mut draw = self.seed.stream([u64::from(generation), u64::from(index)]);
            let start = ground.starts[index as usize / 2 % ground.starts.len()];
            // The first two of a run are the greedy ones.
            let is_greedy = ground.first_wins && index < 2;
            let way = self.ants[index as usize % 2].drive(ground, start, &mut draw, is_greedy);
            let has_arrived = way.died_at.is_none();
            part.0.push(way);
            // Whoever comes later in this part cannot win any more.
            if has_arrived && ground.first_wins {
                return;
            }
        }
    }
}
