//! Analytic expansion: curves straight to the goal.

use super::{DriveProblem, Driven, Guide, State};
use crate::geometry::{Arc, Curve, Point2, Pose2, dubins, reeds_shepp};
use crate::objective::{DriveMeter, VehicleCost};
use crate::vehicle::Gears;

/// Words tried per goal, shortest first.
const MAX_WORDS: usize = 6;
/// Curves from starts to goals that are looked at for a first path.
const MOST_CURVES: usize = 200;
/// Most goals for which words are granted; with more goals, the nearest get most of the words.
const MAX_COUNTED_GOALS: usize = 4;

/// Curves are tried the less often the farther the goal: the interval grows by one state per this
/// many turning radii to go.
const RADII_PER_SHOT: f64 = 3.0;
/// Largest interval between two tries, states.
const MOST_STATES_PER_SHOT: u64 = 32;
/// On the refined lattice, whose states are dense, so many times fewer are tried.
const REFINED_RARITY: u64 = 16;

impl DriveProblem<'_> {
    /// Whether it is time to try a curve to the goal from a position, the n-th that is looked at.
    pub fn wants_shot(&self, guide: &Guide, position: Point2, n: u64) -> bool {
        let Some(to_go_m) = guide.estimate_m(self, position) else {
            return false;
        };
        let every = (to_go_m / (RADII_PER_SHOT * self.map().radius_m())) as u64 + 1;
        let rarity = if self.is_refined() { REFINED_RARITY } else { 1 };
        n.is_multiple_of(rarity * every.min(MOST_STATES_PER_SHOT))
    }

    /// The cheapest free curve from a state to a goal pose among the shortest words, with its
    /// cost.
    pub fn shot(&self, state: &State) -> Option<(Vec<Arc>, f64)> {
        let mut curves: Vec<Curve> = self
            .goals()
            .iter()
            .flat_map(|&goal| self.words(state.pose, goal))
            .collect();
        curves.sort_by(|a, b| a.length_m().total_cmp(&b.length_m()));
        curves.truncate(MAX_WORDS * self.n_goals().min(MAX_COUNTED_GOALS));
        let mut priced: Vec<(f64, Curve)> = curves
            .into_iter()
            .filter_map(|curve| Some((self.price(state, &curve)?, curve)))
            .collect();
        priced.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_free = |curve: &Curve| {
            let mut arcs = curve.placed_arcs(state.pose);
            arcs.all(|(start, arc)| self.is_arc_free(start, arc))
        };
        let (cost, curve) = priced.into_iter().find(|(_, curve)| is_free(curve))?;
        Some((curve.arcs().to_vec(), cost))
    }

    /// The cheapest free curve from a start to a goal pose among all words, as the cost of driving
    /// prices paths.
    ///
    /// Words are priced in the order of their cost on open ground, a lower bound, until none can
    /// be cheaper than the best.
    pub fn cheapest_curve(&self, cost: &VehicleCost) -> Option<Driven> {
        let (obstacles, body) = (self.map().obstacles(), self.map().body());
        let meter = DriveMeter::new(obstacles, body, cost);
        let mut drafts: Vec<(f64, Pose2, Curve)> = Vec::new();
        for &start in self.starts() {
            for &goal in self.goals() {
                let words = self.words(start, goal).into_iter();
                drafts.extend(words.map(|word| (cost.open_path_m(word.arcs()), start, word)));
            }
        }
        drafts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut best: Option<(f64, Driven)> = None;
        for (bound_m, start, word) in drafts.into_iter().take(MOST_CURVES) {
            let best_m = best.as_ref().map_or(f64::INFINITY, |best| best.0);
            if bound_m >= best_m {
                break;
            }
            let mut ends = word
                .placed_arcs(start)
                .map(|(start, arc)| arc.end_from(start));
            if ends.any(|end| self.hits(end.position(), Point2::unit(end.heading))) {
                continue;
            }
            let mut arcs = word.placed_arcs(start);
            if !arcs.all(|(start, arc)| self.is_arc_free(start, arc)) {
                continue;
            }
            let cost_m = meter.path_m(start, word.arcs());
            if cost_m < best_m {
                best = Some((cost_m, (start, word.arcs().to_vec())));
            }
        }
        best.map(|(_, path)| path)
    }

    /// The cost of the cheapest curve from a start to a goal pose on open ground.
    pub fn least_curve_m(&self, cost: &VehicleCost) -> f64 {
        let starts = self.starts().iter();
        let pairs = starts.flat_map(|&start| self.goals().iter().map(move |&goal| (start, goal)));
        let words = pairs.flat_map(|(start, goal)| self.words(start, goal));
        let costs = words.map(|word| cost.open_path_m(word.arcs()));
        costs.fold(f64::INFINITY, f64::min)
    }

    fn words(&self, from: Pose2, to: Pose2) -> Vec<Curve> {
        let radius_m = self.map().radius_m();
        match self.gears() {
            Gears::Forward => dubins::candidates(from, to, radius_m),
            Gears::Both => reeds_shepp::candidates(from, to, radius_m),
        }
    }

    /// The cost of a curve driven after a state, in pieces as long as motion primitives; none
    /// where one of their ends certainly hits something.
    fn price(&self, state: &State, curve: &Curve) -> Option<f64> {
        // A look at a cell costs less than a price, and most curves hit something.
        let mut pieces = self.pieces(state, curve);
        if pieces.any(|(_, mut ends)| ends.any(|(position, along)| self.hits(position, along))) {
            return None;
        }
        let mut before = state.arc;
        let mut total = 0.0;
        for (piece, ends) in self.pieces(state, curve) {
            for (position, along) in ends {
                total += self.cost(before, piece, self.dearness(position, along)?);
                before = piece;
            }
        }
        Some(total)
    }

    /// The arcs of a curve driven after a state, each as a piece that is driven again and again
    /// and the places where that ends.
    fn pieces(
        &self,
        state: &State,
        curve: &Curve,
    ) -> impl Iterator<Item = (Arc, impl Iterator<Item = (Point2, Point2)>)> {
        curve.placed_arcs(state.pose).map(|(start, arc)| {
            let n_pieces = (arc.length_m() / self.piece_m()).ceil().max(1.0) as usize;
            let piece = Arc::new(arc.curvature_per_m, arc.signed_length_m / n_pieces as f64);
            (piece, arc.waypoints(start, n_pieces))
        })
    }
}
