//! Runs on car scenarios beside goals, beside peers on the same scenarios, and beside variants of
//! themselves.

mod goals;
mod numbers;
mod peers;
mod rivals;
mod tables;

pub use peers::Peer;
pub use rivals::Standing;

use crate::analysis::statistics::distinct;
use crate::report::{Report, Section};
use numbers::Runs;

impl Standing {
    /// Goals, variants, peers and all runs, in this order.
    pub fn report(&self) -> Report {
        let of_planners = self.planners().into_iter().map(|name| self.runs_of(name));
        let of_planners: Vec<Runs> = of_planners.collect();
        let mut sections: Vec<Section> =
            of_planners.iter().map(|r| tables::goals(self, r)).collect();
        if of_planners.len() > 1 {
            sections.push(tables::variants(&of_planners));
        }
        sections.extend(tables::beside_peers(self, &of_planners));
        sections.extend(of_planners.iter().map(tables::runs));
        Report {
            name: "standing".to_owned(),
            title: "How the runs stand".to_owned(),
            intro: self.intro(),
            sections,
        }
    }

    fn intro(&self) -> String {
        let motion = if self.forward_only {
            "forward only"
        } else {
            "reverse allowed"
        };
        let peers = if self.peers.is_empty() {
            "Nothing is known of peers: no `peers.csv` lies beside the scenarios."
        } else {
            "Peers' numbers are those of the `peers.csv` beside the scenarios, measured on another \
             day and perhaps another machine."
        };
        format!(
            "{} runs, {motion}. Times are counted from the beginning of a query. A scenario counts \
             with the median over its seeds, a run without a path as one that takes forever. {peers}",
            self.runs.len()
        )
    }

    /// The planners, in the order of their first runs; the plain one of variants first.
    fn planners(&self) -> Vec<&str> {
        distinct(self.runs.iter().map(|run| run.planner.as_str()))
    }

    fn runs_of(&self, planner: &str) -> Runs<'_> {
        Runs::new(self.runs.iter().filter(|run| run.planner == planner))
    }
}

#[cfg(test)]
mod tests;
