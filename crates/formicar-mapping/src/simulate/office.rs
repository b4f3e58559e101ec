//! An office building: a ring corridor, 34 rooms with doors, furniture; and drives through it.

use super::world::{Segment, World};
use formicar::Point2;
use formicar::Seed;
use formicar::numeric::RandomStream;

/// Width and height of the building, meters.
const SIZE: (f64, f64) = (56.0, 36.0);
/// Depth of the outer rooms, meters.
const OUTER_DEPTH: f64 = 5.0;
/// Width of the corridor, meters.
const CORRIDOR: f64 = 2.4;
/// Thickness of walls, meters.
const WALL: f64 = 0.12;
/// Width of doors, meters.
const DOOR: f64 = 1.0;

/// A room, and the way into it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// The point on the center line of the corridor before the door.
    pub before_door: Point2,
    /// The point in the room where a visit ends.
    pub inside: Point2,
    /// Lower corner.
    pub low: Point2,
    /// Upper corner.
    pub high: Point2,
}

/// A building of 56 m x 36 m.
#[derive(Clone, Debug)]
pub struct Office {
    /// Its walls and furniture.
    pub world: World,
    /// Its rooms.
    pub rooms: Vec<Room>,
}

/// A wall from one point to another, parallel to an axis, with doors at distances from its start.
struct Wall {
    from: Point2,
    to: Point2,
    doors: Vec<f64>,
}

impl Office {
    /// The corners of the corridor's center line, counter-clockwise from the lower left.
    pub fn ring() -> [Point2; 4] {
        let inset = OUTER_DEPTH + 0.5 * CORRIDOR;
        let (x1, y1) = (SIZE.0 - inset, SIZE.1 - inset);
        [
            Point2::new(inset, inset),
            Point2::new(x1, inset),
            Point2::new(x1, y1),
            Point2::new(inset, y1),
        ]
    }

    /// A building: sizes of rooms, doors and furniture follow the seed.
    pub fn new(seed: Seed) -> Self {
        let mut plan = Plan {
            random: seed.stream([1, 0]),
            walls: Vec::new(),
            rooms: Vec::new(),
        };
        plan.outer_rooms();
        plan.inner_rooms();
        let mut segments = Vec::new();
        for wall in &plan.walls {
            wall.append(&mut segments);
        }
        let rooms = plan.rooms;
        let mut random = seed.stream([1, 1]);
        for room in &rooms {
            furnish(room, &mut random, &mut segments);
        }
        Self {
            world: World::new(segments),
            rooms,
        }
    }

    /// True if a point is inside the building's outer walls.
    pub fn contains(point: Point2) -> bool {
        (0.0..=SIZE.0).contains(&point.x) && (0.0..=SIZE.1).contains(&point.y)
    }
}

struct Plan {
    random: RandomStream,
    walls: Vec<Wall>,
    rooms: Vec<Room>,
}

impl Plan {
    /// Places that divide a length into parts of about the same size.
    fn division(&mut self, from: f64, to: f64, n: usize) -> Vec<f64> {
        let part = (to - from) / n as f64;
        let mut places = vec![from];
        for i in 1..n {
            places.push(from + part * i as f64 + self.random.range(-0.12, 0.12) * part);
        }
        places.push(to);
        places
    }

    /// A door's place between two walls.
    fn door(&mut self, from: f64, to: f64) -> f64 {
        let (low, high) = (from + 0.8, to - 0.8 - DOOR);
        self.random.range(low, high.max(low + 0.01))
    }

    fn wall(&mut self, from: (f64, f64), to: (f64, f64), doors: Vec<f64>) {
        self.walls.push(Wall {
            from: Point2::new(from.0, from.1),
            to: Point2::new(to.0, to.1),
            doors,
        });
    }

    fn outer_rooms(&mut self) {
        let (w, h) = SIZE;
        let d = OUTER_DEPTH;
        for (a, b) in [
            ((0.0, 0.0), (w, 0.0)),
            ((0.0, h), (w, h)),
            ((0.0, 0.0), (0.0, h)),
            ((w, 0.0), (w, h)),
        ] {
            self.wall(a, b, Vec::new());
        }
        // Rows of eight below and above.
        for (wall_y, edge_y, ring_y) in [
            (d, 0.0, d + 0.5 * CORRIDOR),
            (h - d, h, h - d - 0.5 * CORRIDOR),
        ] {
            // The corner rooms are wider: their doors stand before the corridor, too.
            let mut places = vec![0.0];
            places.extend(self.division(9.0, w - 9.0, 6));
            places.push(w);
            let mut doors = Vec::new();
            for pair in places.windows(2) {
                // The corridor is only before the part between the outer rooms of the sides.
                let end = d + 0.5 * CORRIDOR - 1.2;
                let door = self.door(pair[0].max(end), pair[1].min(w - end));
                doors.push(door);
                let x = door + 0.5 * DOOR;
                self.room(
                    (x, ring_y),
                    (door + 0.5 * DOOR, wall_y),
                    ((pair[0], pair[1]), (edge_y, wall_y)),
                    &Axis::Y,
                );
            }
            self.wall((0.0, wall_y), (w, wall_y), doors);
            for &x in &places[1..places.len() - 1] {
                self.wall((x, edge_y.min(wall_y)), (x, edge_y.max(wall_y)), Vec::new());
            }
        }
        // Columns of three on the left and right, between the rows.
        for (wall_x, edge_x, ring_x) in [
            (d, 0.0, d + 0.5 * CORRIDOR),
            (w - d, w, w - d - 0.5 * CORRIDOR),
        ] {
            let places = self.division(d, h - d, 3);
            let mut doors = Vec::new();
            for pair in places.windows(2) {
                let end = d + 0.5 * CORRIDOR - 1.2;
                let door = self.door(pair[0].max(end), pair[1].min(h - end));
                doors.push(door - d);
                let y = door + 0.5 * DOOR;
                self.room(
                    (ring_x, y),
                    (wall_x, y),
                    ((edge_x, wall_x), (pair[0], pair[1])),
                    &Axis::X,
                );
            }
            self.wall((wall_x, d), (wall_x, h - d), doors);
            for &y in &places[1..places.len() - 1] {
                self.wall((edge_x.min(wall_x), y), (edge_x.max(wall_x), y), Vec::new());
            }
        }
    }

    /// Two rows of six, back to back inside the ring.
    fn inner_rooms(&mut self) {
        let inset = OUTER_DEPTH + CORRIDOR;
        let (x0, x1, y0, y1) = (inset, SIZE.0 - inset, inset, SIZE.1 - inset);
        let middle = 0.5 * (y0 + y1) + self.random.range(-1.0, 1.0);
        self.wall((x0, middle), (x1, middle), Vec::new());
        self.wall((x0, y0), (x0, y1), Vec::new());
        self.wall((x1, y0), (x1, y1), Vec::new());
        for (wall_y, ring_y) in [(y0, y0 - 0.5 * CORRIDOR), (y1, y1 + 0.5 * CORRIDOR)] {
            let places = self.division(x0, x1, 6);
            let mut doors = Vec::new();
            for pair in places.windows(2) {
                let door = self.door(pair[0], pair[1]);
                doors.push(door - x0);
                let x = door + 0.5 * DOOR;
                self.room(
                    (x, ring_y),
                    (x, wall_y),
                    ((pair[0], pair[1]), (middle, wall_y)),
                    &Axis::Y,
                );
            }
            self.wall((x0, wall_y), (x1, wall_y), doors);
            for &x in &places[1..places.len() - 1] {
                self.wall((x, wall_y.min(middle)), (x, wall_y.max(middle)), Vec::new());
            }
        }
    }

    /// A room entered through a door; a visit goes straight in, to about the middle of its depth.
    fn room(
        &mut self,
        before: (f64, f64),
        door: (f64, f64),
        (xs, ys): ((f64, f64), (f64, f64)),
        axis: &Axis,
    ) {
        let depth = self.random.range(0.45, 0.62);
        let inside = match axis {
            Axis::Y => {
                let far = if (ys.0 - door.1).abs() > (ys.1 - door.1).abs() {
                    ys.0
                } else {
                    ys.1
                };
                (door.0, door.1 + depth * (far - door.1))
            }
            Axis::X => {
                let far = if (xs.0 - door.0).abs() > (xs.1 - door.0).abs() {
                    xs.0
                } else {
                    xs.1
                };
                (door.0 + depth * (far - door.0), door.1)
            }
        };
        self.rooms.push(Room {
            before_door: Point2::new(before.0, before.1),
            inside: Point2::new(inside.0, inside.1),
            low: Point2::new(xs.0.min(xs.1), ys.0.min(ys.1)),
            high: Point2::new(xs.0.max(xs.1), ys.0.max(ys.1)),
        });
    }
}

enum Axis {
    X,
    Y,
}

impl Wall {
    /// The four sides of each piece between doors.
    fn append(&self, segments: &mut Vec<Segment>) {
        let length = self.from.distance(self.to);
        let along = (self.to - self.from) * (1.0 / length);
        let across = along.perpendicular() * (0.5 * WALL);
        let mut doors = self.doors.clone();
        doors.sort_by(f64::total_cmp);
        let mut start = -0.5 * WALL;
        for end in doors.iter().copied().chain([length + 0.5 * WALL]) {
            if end > start {
                let (a, b) = (self.from + along * start, self.from + along * end);
                closed(&[a - across, b - across, b + across, a + across], segments);
            }
            start = end + DOOR;
        }
    }
}

fn closed(corners: &[Point2], segments: &mut Vec<Segment>) {
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        segments.push(Segment { a, b });
    }
}

/// Up to four boxes in a room, off the way of a visit.
fn furnish(room: &Room, random: &mut RandomStream, segments: &mut Vec<Segment>) {
    let n_pieces = 2 + random.below(3);
    for _ in 0..n_pieces {
        let (width, depth) = (random.range(0.4, 1.6), random.range(0.3, 0.8));
        let center = Point2::new(
            random.range(room.low.x + 1.0, room.high.x - 1.0),
            random.range(room.low.y + 1.0, room.high.y - 1.0),
        );
        // Most furniture stands square to the walls.
        let turn = if random.unit() < 0.7 {
            0.0
        } else {
            random.range(0.0, 1.5)
        };
        let way = Segment {
            a: room.before_door,
            b: room.inside,
        };
        if way.distance_m(center) < 0.8 + 0.5 * width.hypot(depth) {
            continue;
        }
        let (u, v) = (
            Point2::unit(turn) * (0.5 * width),
            Point2::unit(turn).perpendicular() * (0.5 * depth),
        );
        closed(
            &[
                center - u - v,
                center + u - v,
                center + u + v,
                center - u + v,
            ],
            segments,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_building_has_34_rooms_that_can_be_entered() {
        for seed in 0..5 {
            let office = Office::new(Seed(seed));
            assert_eq!(office.rooms.len(), 34);
            for room in &office.rooms {
                let d = room.inside - room.before_door;
                let along = d * (1.0 / d.norm());
                let range = office.world.range_m(room.before_door, along, 60.0).unwrap();
                assert!(range > d.norm() + 0.2, "seed {seed}: {room:?} {range}");
            }
        }
    }
}
