//! Goals against peers on the same scenarios.

use super::goals::{Goal, ms};
use super::numbers::{Runs, first_s, largest, median, p90, smallest};
use super::peers::Peer;
use crate::run::{RunRecord, number};
use std::collections::BTreeMap;

/// The wanted speed-up over Smac, at the median.
const SMAC_RATIO: f64 = 20.0;
/// Length at 0.1 s and at 1 s beside the best valid peer, at the median.
const LENGTH_RATIOS: [f64; 2] = [1.03, 1.0];

/// Runs of some planners, and the results of peers on the same scenarios.
#[derive(Clone, Debug, Default)]
pub struct Standing {
    /// The runs.
    pub runs: Vec<RunRecord>,
    /// The peers, if any are known.
    pub peers: Vec<Peer>,
    /// True if the runs could drive forward only: their peers are those that drive Dubins curves.
    pub forward_only: bool,
}

impl Standing {
    /// The peers that count: under forward motion, those that drive forward only.
    fn rivals(&self) -> impl Iterator<Item = &Peer> {
        let counts = |peer: &&Peer| !self.forward_only || peer.is_dubins();
        self.peers.iter().filter(counts)
    }

    /// Valid paths of the peers that count on a scenario.
    fn valid<'a>(&'a self, scenario: &'a str) -> impl Iterator<Item = &'a Peer> {
        let is_it = move |peer: &&Peer| peer.scenario == scenario && peer.is_valid();
        self.rivals().filter(is_it)
    }

    /// A peer by the name of its tool, solved scenarios alone.
    fn solved_by(&self, tool: &str) -> BTreeMap<&str, &Peer> {
        let name = format!("{tool}-{}", if self.forward_only { "dubins" } else { "rs" });
        let solved = self
            .peers
            .iter()
            .filter(|p| p.peer == name && p.solved == 1);
        solved.map(|peer| (peer.scenario.as_str(), peer)).collect()
    }

    /// All goals against peers; none of what cannot be compared.
    pub(super) fn against_peers(&self, runs: &Runs) -> Vec<Goal> {
        let smac = self.solved_by("nav2-smac");
        let mut goals = vec![self.solved(runs)];
        goals.extend(faster(runs, "Smac", &smac));
        let connect = self.solved_by("ompl-rrtconnect");
        for source in runs.sources() {
            goals.extend(quicker_on(
                &runs.only(|run| run.source == source),
                source,
                &connect,
            ));
        }
        goals.extend(self.shorter(runs, "0.1 s", LENGTH_RATIOS[0], |run| run.length_by_tenth_m));
        goals.extend(self.shorter(runs, "1 s", LENGTH_RATIOS[1], |run| run.length_by_second_m));
        goals.extend(self.fewer_cusps(runs));
        goals
    }

    /// Every scenario that any peer solves validly, with every seed.
    fn solved(&self, runs: &Runs) -> Goal {
        let has_peers = !self.peers.is_empty();
        let wanted = runs.only(|run| !has_peers || self.valid(&run.scenario).next().is_some());
        let (n_solved, n) = (wanted.n_solved(), wanted.all.len());
        let n_scenarios = wanted.by_scenario.len();
        let who = match (has_peers, self.forward_only) {
            (false, _) => "",
            (true, true) => " that a Dubins peer solves",
            (true, false) => " that any peer solves",
        };
        let wanted = format!("all seeds of all {n_scenarios} scenarios{who}");
        let reached = format!("{n_solved} of {n} runs");
        Goal::new("solved and certified", &wanted, reached, n_solved == n)
    }

    fn shorter(
        &self,
        runs: &Runs,
        by: &str,
        most: f64,
        length_m: impl Fn(&RunRecord) -> Option<f64>,
    ) -> Option<Goal> {
        let ratio = |scenario: &&str| {
            let best = self.valid(scenario).filter_map(|peer| peer.length_1s_m);
            let best_m = smallest(&best.collect::<Vec<_>>())?;
            Some(runs.median_of(scenario, &length_m)? / best_m)
        };
        let ratios: Vec<f64> = runs.by_scenario.keys().filter_map(ratio).collect();
        let n_known = ratios.iter().filter(|r| r.is_finite()).count();
        let (median, worst) = (median(&ratios)?, largest(&ratios)?);
        Some(Goal::new(
            &format!("length at {by} / best valid peer at 1 s"),
            &format!("median <= {most:.2}"),
            format!(
                "{median:.3}, worst {worst:.3}, with a path by then in {n_known} of {}",
                ratios.len()
            ),
            median <= most,
        ))
    }

    /// Beside the peer with the fewest changes of gear on average over its valid paths.
    fn fewer_cusps(&self, runs: &Runs) -> Option<Goal> {
        let n_ours = |scenario: &str| runs.median_of(scenario, |run| number(run.n_cusps));
        let mut by_peer: BTreeMap<&str, Vec<[f64; 2]>> = BTreeMap::new();
        for peer in self.rivals().filter(|p| p.is_valid()) {
            // Who drives forward only where reverse is allowed solves other, easier scenarios.
            let is_alike = self.forward_only || !peer.is_dubins();
            if let (true, Some(theirs), Some(ours)) = (is_alike, peer.cusps, n_ours(&peer.scenario))
            {
                by_peer.entry(&peer.peer).or_default().push([ours, theirs]);
            }
        }
        let mean = |pairs: &[[f64; 2]], i: usize| {
            pairs.iter().map(|pair| pair[i]).sum::<f64>() / pairs.len() as f64
        };
        let fewest = by_peer.iter();
        let fewest = fewest.min_by(|a, b| mean(a.1, 1).total_cmp(&mean(b.1, 1)));
        let (name, pairs) = fewest?;
        let (ours, theirs) = (mean(pairs, 0), mean(pairs, 1));
        let n_more = pairs.iter().filter(|[ours, theirs]| ours > theirs).count();
        Some(Goal::new(
            "cusps beside the peer with fewest",
            &format!("mean <= {theirs:.2} ({name})"),
            format!(
                "{ours:.2}, more than it in {n_more} of its {} valid",
                pairs.len()
            ),
            ours <= theirs,
        ))
    }
}

/// The speed-up over a peer, by scenario; 0 where there is no path.
fn ratios(runs: &Runs, peers: &BTreeMap<&str, &Peer>) -> Vec<f64> {
    let ratio = |scenario: &&str| {
        let ours_s = runs.median_of(scenario, |run| Some(first_s(run)))?;
        Some(peers.get(scenario)?.first_s? / ours_s)
    };
    runs.by_scenario.keys().filter_map(ratio).collect()
}

fn faster(runs: &Runs, tool: &str, peers: &BTreeMap<&str, &Peer>) -> Option<Goal> {
    let ratios = ratios(runs, peers);
    let (median, worst) = (median(&ratios)?, smallest(&ratios)?);
    Some(Goal::new(
        &format!("first path, times faster than {tool}"),
        &format!("median >= {SMAC_RATIO}, worst >= 1"),
        format!(
            "{median:.1}, worst {worst:.2}, of {} scenarios",
            ratios.len()
        ),
        median >= SMAC_RATIO && worst >= 1.0,
    ))
}

/// First paths on a map beside those of RRT-Connect: both quantiles over scenarios.
fn quicker_on(runs: &Runs, source: &str, peers: &BTreeMap<&str, &Peer>) -> Option<Goal> {
    let ours = |scenario: &&str| runs.median_of(scenario, |run| Some(first_s(run)));
    let theirs = |scenario: &&str| peers.get(*scenario)?.first_s;
    let ours: Vec<f64> = runs.by_scenario.keys().filter_map(ours).collect();
    let theirs: Vec<f64> = runs.by_scenario.keys().filter_map(theirs).collect();
    let both = |values: &[f64]| Some([ms(median(values)?), ms(p90(values)?)]);
    let (ours, theirs) = (both(&ours)?, both(&theirs)?);
    let ratios = ratios(runs, peers);
    let (times, worst) = (median(&ratios)?, smallest(&ratios)?);
    Some(Goal::new(
        &format!("first path beside RRT-Connect, `{source}`"),
        &format!("median < {:.1} ms, p90 < {:.1} ms", theirs[0], theirs[1]),
        format!(
            "{:.1} / {:.1} ms; times faster: median {times:.2}, worst {worst:.2}",
            ours[0], ours[1]
        ),
        ours[0] < theirs[0] && ours[1] < theirs[1],
    ))
}
