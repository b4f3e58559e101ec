//! All states on the lattice that can be reached without entering a forbidden region.
//!
//! A layer holds the states at the end of a time step: for each stretch and each mode the set of
//! places, as bits. The next layer is the union of all moves of all places at once, without those
//! that would drive over a closed place or faster than allowed. Nothing is pruned and nothing is
//! estimated, so that a state is in its layer if and only if some profile of the lattice reaches it.

use super::bits::{self, Bits};
use super::forbidden::Forbidden;
use super::steps::Steps;
use super::stretch::{Begin, Stretch, between_stops, fitted};
use crate::path::{Phase, SpeedLimits, TimedState};

/// A state of the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct State {
    pub(super) layer: usize,
    pub(super) stretch: usize,
    pub(super) mode: usize,
    pub(super) unit: usize,
}

/// The lattice of a path.
pub(super) struct Lattice {
    pub(super) stretches: Vec<Stretch>,
    pub(super) time_step_s: f64,
    /// Time steps for which the vehicle stands before each stretch.
    n_standing: Vec<usize>,
    first: State,
}

/// Sets of places by stretch and mode; empty where there are none.
type Layer = Vec<Vec<Bits>>;

/// The layers up to some time.
pub(super) struct Reached<'a> {
    lattice: &'a Lattice,
    forbidden: &'a Forbidden,
    layers: Vec<Layer>,
}

/// The mode of a vehicle that stands.
pub(super) const REST: usize = 0;

impl Lattice {
    /// The lattice from a place on, where the vehicle has a speed; `layer` time steps have passed.
    /// None where the path ends there or the speed is on no lattice.
    pub(super) fn new(
        steps: &Steps,
        limits: &SpeedLimits,
        time_step_s: f64,
        (begin, layer): (Begin, usize),
    ) -> Option<Self> {
        let mut begin = begin;
        let mut stretches = Vec::new();
        for of_stretch in between_stops(steps, begin.s_m) {
            stretches.push(Stretch::new(&of_stretch, begin, limits, time_step_s));
            begin = Begin::at_rest(stretches[stretches.len() - 1].end_m);
        }
        let first = stretches.first_mut()?;
        first.stands_s = 0.0;
        let n_standing = stretches.iter();
        let n_standing = n_standing.map(|s| (s.stands_s / time_step_s - SAME_TIME).ceil() as usize);
        Some(Self {
            n_standing: n_standing.collect(),
            first: State {
                layer,
                stretch: 0,
                mode: REST,
                unit: 0,
            },
            stretches,
            time_step_s,
        })
    }

    /// The same, where the first mode is that of a speed.
    pub(super) fn starting_at(mut self, speed_mps: f64) -> Option<Self> {
        self.first.mode = self.stretches[0].steady(speed_mps)?;
        Some(self)
    }

    /// Words of a layer that is full.
    pub(super) fn n_words(&self) -> usize {
        let words = self.stretches.iter();
        words
            .map(|s| s.modes.len() * bits::words(s.n_units + 1))
            .sum()
    }

    /// The time step that suits a beginning, at most the one wished for, and the beginning on it.
    pub(super) fn fitted(
        steps: &Steps,
        limits: &SpeedLimits,
        begin: Begin,
        wished_s: f64,
    ) -> (f64, Begin) {
        let stretches = between_stops(steps, begin.s_m);
        let first = stretches.first().map_or(&[][..], Vec::as_slice);
        fitted(first, begin, limits, wished_s)
    }

    pub(super) fn timed(&self, state: State) -> TimedState {
        let stretch = &self.stretches[state.stretch];
        let mode = stretch.modes[state.mode];
        TimedState {
            t_s: state.layer as f64 * self.time_step_s,
            s_m: stretch.place_m(state.unit),
            speed_mps: mode.speed as f64 * stretch.speed_step_mps,
            acceleration_mps2: mode.acceleration as f64 * stretch.acceleration_step_mps2,
        }
    }

    /// The last place of the path, standing.
    pub(super) fn end(&self, layer: usize) -> State {
        let stretch = self.stretches.len() - 1;
        State {
            layer,
            stretch,
            mode: REST,
            unit: self.stretches[stretch].n_units,
        }
    }

    /// The phases of a chain of states; equal ones are one.
    pub(super) fn phases(&self, states: &[State]) -> Vec<Phase> {
        let mut phases: Vec<Phase> = Vec::new();
        for pair in states.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|state| self.timed(state));
            let duration_s = b.t_s - a.t_s;
            if duration_s <= 0.0 {
                continue;
            }
            let jerk_mps3 = (b.acceleration_mps2 - a.acceleration_mps2) / duration_s;
            let changes = a.acceleration_mps2 != 0.0 || b.acceleration_mps2 != 0.0;
            let acceleration_mps2 = if changes {
                a.acceleration_mps2
            } else {
                (b.speed_mps - a.speed_mps) / duration_s
            };
            match phases.last_mut() {
                Some(last)
                    if last.jerk_mps3 == 0.0
                        && jerk_mps3 == 0.0
                        && last.acceleration_mps2 == 0.0
                        && acceleration_mps2 == 0.0
                        && last.speed_mps == a.speed_mps
                        && pair[0].stretch == pair[1].stretch =>
                {
                    last.duration_s = b.t_s - last.t_s;
                }
                _ => phases.push(Phase {
                    t_s: a.t_s,
                    s_m: a.s_m,
                    speed_mps: a.speed_mps,
                    acceleration_mps2,
                    jerk_mps3,
                    duration_s,
                }),
            }
        }
        phases
    }
}

/// Shares of a time step that are smaller are none.
const SAME_TIME: f64 = 1e-9;

impl<'a> Reached<'a> {
    /// The beginning alone; nothing where that is closed.
    pub(super) fn new(lattice: &'a Lattice, forbidden: &'a Forbidden) -> Self {
        let blank = || {
            lattice
                .stretches
                .iter()
                .map(|s| vec![Bits::new(); s.modes.len()])
        };
        let mut layers: Vec<Layer> = (0..=lattice.first.layer)
            .map(|_| blank().collect())
            .collect();
        let mut places = vec![0; bits::words(lattice.stretches[0].n_units + 1)];
        bits::insert(&mut places, 0);
        layers[lattice.first.layer][0][lattice.first.mode] = places;
        Self {
            lattice,
            forbidden,
            layers,
        }
    }

    /// The index of the last layer.
    pub(super) fn last(&self) -> usize {
        self.layers.len() - 1
    }

    /// True if some state is in the last layer, or on its way into one while the vehicle stands.
    pub(super) fn is_alive(&self) -> bool {
        let layer = &self.layers[self.last()];
        layer.iter().flatten().any(|places| !places.is_empty())
    }

    pub(super) fn contains(&self, state: State) -> bool {
        let places = &self.layers[state.layer][state.stretch][state.mode];
        bits::contains(places, state.unit)
    }

    /// The places of a mode in a layer.
    pub(super) fn places(&self, layer: usize, stretch: usize, mode: usize) -> &[u64] {
        &self.layers[layer][stretch][mode]
    }

    /// Adds a layer.
    pub(super) fn advance(&mut self) {
        let slab = self.last();
        let stretches = self.lattice.stretches.iter().enumerate();
        let next = stretches.map(|(i, stretch)| self.moved(slab, i, stretch));
        let next: Layer = next.collect();
        self.layers.push(next);
        for i in 1..self.lattice.stretches.len() {
            if self.may_begin(slab + 1, i) {
                let n_words = bits::words(self.lattice.stretches[i].n_units + 1);
                let places = &mut self.layers[slab + 1][i][REST];
                places.resize(n_words, 0);
                bits::insert(places, 0);
            }
        }
    }

    /// All places of a stretch after a time step.
    fn moved(&self, slab: usize, i: usize, stretch: &Stretch) -> Vec<Bits> {
        let n_words = bits::words(stretch.n_units + 1);
        let closed: Vec<_> = self.closed_units(slab, stretch);
        let mut next = vec![Bits::new(); stretch.modes.len()];
        let mut moving = Bits::new();
        for step in &stretch.moves {
            let places = &self.layers[slab][i][step.from];
            if places.is_empty() {
                continue;
            }
            moving.clone_from(places);
            bits::clear(
                &mut moving,
                (stretch.n_units + 1).saturating_sub(step.advance),
                64 * n_words,
            );
            if step.advance == 0 {
                self.clear_closed_places(slab, stretch, &mut moving);
            } else {
                let slow = &stretch.too_fast[step.speed];
                for &[low, high] in closed.iter().chain(slow) {
                    bits::clear(&mut moving, (low + 1).saturating_sub(step.advance), high);
                }
            }
            if moving.iter().any(|&word| word != 0) {
                let to = &mut next[step.to];
                to.resize(n_words, 0);
                bits::unite_moved(to, &moving, step.advance);
            }
        }
        next
    }

    fn closed_units(&self, slab: usize, stretch: &Stretch) -> Vec<[usize; 2]> {
        let closed = self.forbidden.closed(slab).iter();
        let units = closed.map(|&run| stretch.units_of(run));
        units.filter(|[low, high]| low < high).collect()
    }

    /// Removes the places where the vehicle cannot stand: those strictly inside, and an end of the
    /// path.
    fn clear_closed_places(&self, slab: usize, stretch: &Stretch, places: &mut Bits) {
        for [low, high] in self.closed_units(slab, stretch) {
            bits::clear(places, low + 1, high);
            for unit in [low, high] {
                if !self.is_open(slab, stretch.place_m(unit)) {
                    bits::clear(places, unit, unit + 1);
                }
            }
        }
    }

    fn is_open(&self, slab: usize, s_m: f64) -> bool {
        self.forbidden.is_open(slab, [s_m, s_m])
    }

    /// True if the vehicle has stood before a stretch for as long as it must.
    fn may_begin(&self, layer: usize, stretch: usize) -> bool {
        let n_standing = self.lattice.n_standing[stretch];
        let Some(since) = layer.checked_sub(n_standing) else {
            return false;
        };
        let before = &self.lattice.stretches[stretch - 1];
        let waits = State {
            layer: since,
            stretch: stretch - 1,
            mode: REST,
            unit: before.n_units,
        };
        self.contains(waits) && (since..layer).all(|slab| self.is_open(slab, before.end_m))
    }

    /// A chain of states that leads to one in a layer; of several, one that changes its speed late
    /// and little.
    pub(super) fn way_to(&self, last: State) -> Vec<State> {
        let mut way = vec![last];
        let mut here = last;
        while let Some(before) = self.before(here) {
            way.push(before);
            here = before;
        }
        way.reverse();
        way
    }

    fn before(&self, here: State) -> Option<State> {
        if here == self.lattice.first {
            return None;
        }
        let begins = here.stretch > 0 && here.unit == 0 && here.mode == REST;
        if begins && self.may_begin(here.layer, here.stretch) {
            return Some(State {
                layer: here.layer - self.lattice.n_standing[here.stretch],
                stretch: here.stretch - 1,
                mode: REST,
                unit: self.lattice.stretches[here.stretch - 1].n_units,
            });
        }
        let slab = here.layer.checked_sub(1)?;
        let stretch = &self.lattice.stretches[here.stretch];
        let closed = self.closed_units(slab, stretch);
        let mut into = stretch.moves.iter().filter(|step| step.to == here.mode);
        into.find_map(|step| {
            let before = State {
                layer: slab,
                stretch: here.stretch,
                mode: step.from,
                unit: here.unit.checked_sub(step.advance)?,
            };
            let apart = |run: &[usize; 2]| run[1] <= before.unit || run[0] >= here.unit;
            let is_free = if step.advance == 0 {
                self.is_open(slab, stretch.place_m(here.unit))
            } else {
                closed
                    .iter()
                    .chain(&stretch.too_fast[step.speed])
                    .all(apart)
            };
            (is_free && self.contains(before)).then_some(before)
        })
    }
}
