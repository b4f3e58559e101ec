//! Employed bees, onlookers and scouts (Karaboga 2005; Karaboga & Basturk 2007).

use super::source::Source;
use super::{BeeColonyConfig, ParameterSpace, SearchRule, TuningError};
use crate::numeric::{RandomStream, Seed};

/// The result of a cycle.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct CycleRecord {
    /// Evaluations so far.
    pub n_evaluations: u64,
    /// Least cost so far.
    pub best_cost: f64,
    /// Cost of the sources after the cycle: the middle one (the upper of two).
    pub median_cost: f64,
    /// Candidates that were better than their source.
    pub n_gains: u32,
    /// True if a source was abandoned.
    pub scouted: bool,
}

/// The kind of bee that searches; part of the key of a random number.
#[derive(Clone, Copy, Debug)]
enum Phase {
    First,
    Employed,
    Onlooker,
    Scout,
}

/// A search for values of least cost, cycle by cycle.
///
/// The bees of a phase set out from the sources as they were at its beginning, so that their
/// candidates can be evaluated at once; in the papers they follow one another. Everything else is
/// theirs: greedy selection between candidate and source, onlookers that draw a source in
/// proportion to its fitness, and one scout a cycle at most, for the source with the most trials
/// where these are above the limit.
///
/// The state is what serde writes: read again, the search goes on with the same bits.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct BeeColony {
    space: ParameterSpace,
    config: BeeColonyConfig,
    seed: Seed,
    /// Positions at which the first sources are.
    known: Vec<Vec<f64>>,
    sources: Vec<Source>,
    best: Option<Source>,
    /// Gains of each rule, begun at 1.
    counters: Vec<u64>,
    n_evaluations: u64,
    history: Vec<CycleRecord>,
}

/// Gives the costs of candidates, in their order.
pub(super) type Evaluate<'a> = &'a mut dyn FnMut(&[Vec<f64>]) -> Vec<f64>;

impl BeeColony {
    /// A colony that has not set out yet.
    ///
    /// # Errors
    /// A parameter outside its range.
    pub fn new(
        space: ParameterSpace,
        config: BeeColonyConfig,
        seed: Seed,
    ) -> Result<Self, TuningError> {
        config.check()?;
        Ok(Self {
            counters: vec![1; config.variant.rules().len()],
            space,
            config,
            seed,
            known: Vec::new(),
            sources: Vec::new(),
            best: None,
            n_evaluations: 0,
            history: Vec::new(),
        })
    }

    /// The same with a first source at values that are known to be good; to be called before the
    /// first cycle, at most once for each source.
    ///
    /// # Errors
    /// Values outside the space.
    pub fn with_known(mut self, values: &[f64]) -> Result<Self, TuningError> {
        self.known.push(self.space.position(values)?);
        self.check()?;
        Ok(self)
    }

    /// Checks a state that was read: one cycle after another has made it, or might have.
    ///
    /// # Errors
    /// The part that does not fit.
    pub fn check(&self) -> Result<(), TuningError> {
        self.space.check()?;
        self.config.check()?;
        let fault = |what| Err(TuningError::State { what });
        let n_sources = self.config.n_sources as usize;
        if self.known.len() > n_sources {
            return fault("more known places than sources");
        }
        let has_begun = !self.history.is_empty();
        if self.sources.len() != if has_begun { n_sources } else { 0 } {
            return fault("the number of sources is another");
        }
        if self.best.is_some() != has_begun {
            return fault("a best place without a cycle, or the reverse");
        }
        let n_dimensions = self.space.dimensions().len();
        let sources = self.sources.iter().chain(&self.best);
        let positions = sources.map(|source| &source.position).chain(&self.known);
        let is_inside = |p: &Vec<f64>| {
            p.len() == n_dimensions && p.iter().all(|place| (0.0..=1.0).contains(place))
        };
        if !positions.into_iter().all(is_inside) {
            return fault("a place outside the space");
        }
        if self.counters.len() != self.config.variant.rules().len() || self.counters.contains(&0) {
            return fault("counters of other rules");
        }
        Ok(())
    }

    /// True if all evaluations are used up.
    pub fn is_done(&self) -> bool {
        self.n_left() == 0
    }

    /// The next cycle; the first finds the sources. Nothing where the search is done.
    ///
    /// `evaluate` gets the values of candidates and gives their costs in the same order. A cost
    /// that is no finite number counts as the worst, `f64::MAX`.
    ///
    /// # Errors
    /// Not one cost for each candidate; the colony is then of no further use.
    pub fn cycle(&mut self, evaluate: Evaluate) -> Result<(), TuningError> {
        if self.is_done() {
            return Ok(());
        }
        let (n_gains, scouted) = if self.sources.is_empty() {
            self.find_first(evaluate)?;
            (0, false)
        } else {
            let employed = (0..self.sources.len()).collect();
            let mut n_gains = self.search(Phase::Employed, employed, evaluate)?;
            let onlookers = self.onlookers();
            n_gains += self.search(Phase::Onlooker, onlookers, evaluate)?;
            (n_gains, self.scout(evaluate)?)
        };
        self.record(n_gains, scouted);
        Ok(())
    }

    /// The best place so far; none before the first cycle.
    pub fn best(&self) -> Option<&Source> {
        self.best.as_ref()
    }

    /// The values at the best place so far.
    pub fn best_values(&self) -> Option<Vec<f64>> {
        let best = self.best.as_ref()?;
        Some(self.space.values(&best.position))
    }

    /// The food sources as they are.
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// Evaluations so far.
    pub fn n_evaluations(&self) -> u64 {
        self.n_evaluations
    }

    /// The results of the cycles.
    pub fn history(&self) -> &[CycleRecord] {
        &self.history
    }

    /// The rules in use, and how often each has gained.
    pub fn gains(&self) -> impl Iterator<Item = (SearchRule, u64)> + '_ {
        let rules = self.config.variant.rules().iter();
        rules.zip(&self.counters).map(|(&rule, n)| (rule, n - 1))
    }

    /// The space.
    pub fn space(&self) -> &ParameterSpace {
        &self.space
    }

    /// The parameters of the search.
    pub fn config(&self) -> &BeeColonyConfig {
        &self.config
    }

    /// True if another colony was begun like this one: it may be further along.
    pub fn began_like(&self, other: &Self) -> bool {
        let begun = |colony: &Self| (colony.config.clone(), colony.seed, colony.known.clone());
        self.space == other.space && begun(self) == begun(other)
    }

    fn n_left(&self) -> u64 {
        let n_most = self.config.max_evaluations;
        n_most.saturating_sub(self.n_evaluations)
    }

    /// The random numbers of a bee in this cycle.
    fn stream(&self, phase: Phase, bee: usize) -> RandomStream {
        let cycle = self.history.len() as u64;
        self.seed.stream([4 * cycle + phase as u64, bee as u64])
    }

    fn anywhere(&self, mut random: RandomStream) -> Vec<f64> {
        let dimensions = self.space.dimensions();
        dimensions.iter().map(|_| random.unit()).collect()
    }

    /// Known places first, then any.
    fn find_first(&mut self, evaluate: Evaluate) -> Result<(), TuningError> {
        let n_sources = self.config.n_sources as usize;
        let any =
            (self.known.len()..n_sources).map(|i| self.anywhere(self.stream(Phase::First, i)));
        let positions = self.known.iter().cloned().chain(any).collect();
        self.sources = self.evaluated(positions, evaluate)?;
        Ok(())
    }

    /// Evaluates as many of these places as evaluations are left, and keeps the best in mind.
    fn evaluated(
        &mut self,
        mut positions: Vec<Vec<f64>>,
        evaluate: Evaluate,
    ) -> Result<Vec<Source>, TuningError> {
        positions.truncate(usize::try_from(self.n_left()).unwrap_or(usize::MAX));
        if positions.is_empty() {
            return Ok(Vec::new());
        }
        let values: Vec<Vec<f64>> = positions.iter().map(|p| self.space.values(p)).collect();
        let costs = evaluate(&values);
        if costs.len() != positions.len() {
            return Err(TuningError::Costs {
                n_candidates: positions.len(),
                n_costs: costs.len(),
            });
        }
        self.n_evaluations += costs.len() as u64;
        let pairs = positions.into_iter().zip(costs);
        let sources: Vec<Source> = pairs
            .map(|(position, cost)| Source {
                position,
                cost: if cost.is_finite() { cost } else { f64::MAX },
                n_trials: 0,
            })
            .collect();
        for source in &sources {
            if self
                .best
                .as_ref()
                .is_none_or(|best| source.cost < best.cost)
            {
                self.best = Some(source.clone());
            }
        }
        Ok(sources)
    }

    /// The source of each onlooker, drawn in proportion to fitness (Karaboga & Basturk 2007 (2.1)).
    fn onlookers(&self) -> Vec<usize> {
        let shares: Vec<f64> = self.sources.iter().map(Source::fitness).collect();
        let bees = 0..self.sources.len();
        bees.map(|bee| drawn(&shares, &mut self.stream(Phase::Onlooker, bee)))
            .collect()
    }

    /// Sends a bee to each of these sources, and keeps what is better; the number of gains.
    fn search(
        &mut self,
        phase: Phase,
        places: Vec<usize>,
        evaluate: Evaluate,
    ) -> Result<u32, TuningError> {
        let Some(best) = self.best.as_ref().map(|best| best.position.clone()) else {
            return Ok(0);
        };
        let rules = self.config.variant.rules();
        let shares: Vec<f64> = self.counters.iter().map(|&n| n as f64).collect();
        let search = |(bee, &i): (usize, &usize)| {
            // Draws of onlookers' choices stand before those of their searches.
            let mut random = self.stream(phase, bee + self.sources.len());
            let rule = drawn(&shares, &mut random);
            let candidate = rules[rule].candidate(&self.sources, i, &best, &mut random);
            (rule, candidate)
        };
        let (rules, candidates): (Vec<usize>, Vec<Vec<f64>>) =
            places.iter().enumerate().map(search).unzip();
        let candidates = self.evaluated(candidates, evaluate)?;
        let mut n_gains = 0;
        for ((candidate, i), rule) in candidates.into_iter().zip(places).zip(rules) {
            if candidate.cost < self.sources[i].cost {
                self.sources[i] = candidate;
                self.counters[rule] += 1;
                n_gains += 1;
            } else {
                self.sources[i].n_trials += 1;
            }
        }
        Ok(n_gains)
    }

    /// Abandons the source with the most trials, the first of equals, where these are above the
    /// limit; whether it did.
    fn scout(&mut self, evaluate: Evaluate) -> Result<bool, TuningError> {
        let limit = self.config.limit_in(self.space.dimensions().len());
        let numbered = self.sources.iter().enumerate().rev();
        let Some((i, source)) = numbered.max_by_key(|(_, source)| source.n_trials) else {
            return Ok(false);
        };
        if source.n_trials <= limit {
            return Ok(false);
        }
        let anywhere = self.anywhere(self.stream(Phase::Scout, 0));
        let Some(found) = self.evaluated(vec![anywhere], evaluate)?.pop() else {
            return Ok(false);
        };
        self.sources[i] = found;
        Ok(true)
    }

    fn record(&mut self, n_gains: u32, scouted: bool) {
        let mut costs: Vec<f64> = self.sources.iter().map(|source| source.cost).collect();
        costs.sort_by(f64::total_cmp);
        let best_cost = self.best.as_ref().map_or(f64::MAX, |best| best.cost);
        self.history.push(CycleRecord {
            n_evaluations: self.n_evaluations,
            best_cost,
            median_cost: costs[costs.len() / 2],
            n_gains,
            scouted,
        });
    }
}

/// A place drawn in proportion to its share; all shares are at least 0.
fn drawn(shares: &[f64], random: &mut RandomStream) -> usize {
    let mut left = random.unit() * shares.iter().sum::<f64>();
    for (place, share) in shares.iter().enumerate() {
        if left < *share {
            return place;
        }
        left -= share;
    }
    shares.len() - 1
}
