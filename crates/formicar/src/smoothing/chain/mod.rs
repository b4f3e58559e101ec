//! The cheapest collision-free chain of pieces along a polyline.
//!
//! A* over junctions and facings. A piece goes on the open list with its cost and is checked for
//! collisions only when it comes up: most never do. The estimate of the rest is the cost of the
//! cheapest chain without obstacles, with every curve as short as a straight line.

mod bounds;
mod free;
mod node;
mod opening;

use super::open_list::OpenList;
use super::roadmap::{Facing, Roadmap};
use super::task::RoundingTask;
use crate::geometry::{Arc, Curve, Pose2};
use node::{Node, NodeMap};

/// A piece of a chain: arcs from a pose, and the 2-turning that they are, if so.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) start: Pose2,
    pub(super) arcs: Vec<Arc>,
    pub(super) member: Option<usize>,
}

/// The way from one node to another.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// To the next junction of the leg.
    Straight,
    /// By a 2-turning of the list.
    Turning(usize),
    /// By some curve, at a lower bound of its cost.
    AnyWord,
    /// By a curve of the list.
    Word(usize),
    /// The start or the goal with the polyline's own heading: nothing to drive.
    Here,
}

/// Two nodes, in driving order.
#[derive(Clone, Copy, Debug)]
struct Span {
    from: Node,
    to: Node,
}

/// A step between two nodes.
#[derive(Clone, Copy, Debug)]
struct Move {
    span: Span,
    step: Step,
}

/// The end of a search in which no chain reached the goal.
#[derive(Clone, Debug)]
pub(super) struct Stuck {
    /// The junctions reached, in order along the polyline.
    pub(super) reached: Vec<(usize, Facing)>,
}

/// The cheapest chain from start to goal.
pub(super) fn cheapest(task: &RoundingTask, map: &Roadmap) -> Result<Vec<Piece>, Stuck> {
    let mut search = Search::new(task, map);
    search.open_start();
    while let Some(entry) = search.open.pop()
        && !task.is_over()
    {
        let Move { span, step } = entry.item;
        if search.came_by[span.to].is_some() {
            continue;
        }
        if matches!(step, Step::AnyWord) {
            search.expand(span);
        } else if search.is_free(span.from, step) {
            search.came_by[span.to] = Some((span.from, step));
            search.costs[span.to] = entry.cost;
            match span.to {
                Node::Passing(junction, facing) => search.open_from(junction, facing),
                Node::Goal => return Ok(search.pieces()),
                Node::Start => {}
            }
        }
    }
    Err(search.stuck())
}

/// A search in progress.
struct Search<'a> {
    task: &'a RoundingTask<'a>,
    map: &'a Roadmap,
    /// The step by which each node was reached first, and its cost.
    came_by: NodeMap<Option<(Node, Step)>>,
    costs: NodeMap<f64>,
    /// Lower bound of the cost of the rest of the path, by junction.
    remaining: Vec<f64>,
    open: OpenList<Move>,
    /// Curves with the poses from which they are driven.
    words: Vec<(Pose2, Curve)>,
    /// By leg and facing, whether the body can drive from each junction to the next.
    straights: Vec<[Option<Vec<bool>>; 2]>,
}

impl<'a> Search<'a> {
    fn new(task: &'a RoundingTask<'a>, map: &'a Roadmap) -> Self {
        let n_junctions = map.junctions.len();
        let mut search = Self {
            task,
            map,
            came_by: NodeMap::new(n_junctions, None),
            costs: NodeMap::new(n_junctions, 0.0),
            open: OpenList::default(),
            words: Vec::new(),
            straights: vec![[const { None }; 2]; map.legs.len()],
            remaining: vec![f64::INFINITY; n_junctions],
        };
        for junction in (0..n_junctions).rev() {
            if task.is_over() {
                break;
            }
            search.remaining[junction] = search.least_remaining(junction);
        }
        search
    }

    fn push(&mut self, cost: f64, span: Span, step: Step) {
        let remaining = match span.to {
            Node::Passing(junction, _) => self.remaining[junction],
            Node::Start | Node::Goal => 0.0,
        };
        self.open.push([cost, remaining], Move { span, step });
    }

    /// The pieces from start to goal.
    fn pieces(&self) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut node = Node::Goal;
        while let Some((from, step)) = self.came_by[node] {
            // A free start stands where its first piece does.
            let at = if from == Node::Start { node } else { from };
            let (start, arcs) = self.motion(at, step);
            let member = match step {
                Step::Turning(member) => Some(member),
                _ => None,
            };
            pieces.push(Piece {
                start,
                arcs,
                member,
            });
            node = from;
        }
        pieces.reverse();
        pieces
    }

    fn stuck(&self) -> Stuck {
        let junctions = 0..self.map.junctions.len();
        let all = junctions.flat_map(|junction| Facing::ALL.map(|facing| (junction, facing)));
        let is_reached = |&(junction, facing): &(usize, Facing)| {
            self.came_by[Node::Passing(junction, facing)].is_some()
        };
        Stuck {
            reached: all.filter(is_reached).collect(),
        }
    }
}
