//! The list of built-in maps with their vehicles and requests.

use super::entry::{BuiltinKind, BuiltinMap, BuiltinRequest, Source};
use super::{narrow, scenes};
use crate::geometry::Pose2;
use std::f64::consts::{FRAC_PI_2, PI};

const EAST: f64 = 0.0;
const NORTH: f64 = FRAC_PI_2;
const WEST: f64 = PI;
const SOUTH: f64 = -FRAC_PI_2;

pub(super) static MAPS: [BuiltinMap; 16] = [
    BuiltinMap {
        name: "lei-map1",
        about: "21 x 21 cells of 0.5 m, half the width of the lei2020 vehicle, as in Lei & Zheng 2020: \
                two U-shaped traps between start and goal. The way around stays open when obstacles \
                grow by one cell, and the vehicle can drive it without reverse.",
        kind: BuiltinKind::GridProblem,
        vehicle: "lei2020",
        requests: &[request("across", [0.75, 0.75, EAST], [9.25, 4.25, SOUTH])],
        source: Source::Text(include_str!("../../../maps/lei-map1.txt"), 0.5),
    },
    BuiltinMap {
        name: "lei-map2",
        about: "40 x 40 cells of 0.5 m for the lei2020 vehicle: four U-shapes that open in four \
                directions, among blocks. The way stays open when obstacles grow by one cell, and the \
                vehicle can drive it without reverse.",
        kind: BuiltinKind::GridProblem,
        vehicle: "lei2020",
        requests: &[request("across", [0.75, 0.75, EAST], [19.25, 16.75, NORTH])],
        source: Source::Text(include_str!("../../../maps/lei-map2.txt"), 0.5),
    },
    BuiltinMap {
        name: "lei-map3",
        about: "40 x 40 cells of 0.5 m for the lei2020 vehicle: long walls force the way up, down \
                and up again past U-shapes and hooks; 82 cells long without cutting corners, 34 \
                if nothing stood there. The way stays open when obstacles grow by one cell, and the \
                vehicle can drive it without reverse.",
        kind: BuiltinKind::GridProblem,
        vehicle: "lei2020",
        requests: &[request("across", [0.75, 0.75, NORTH], [17.25, 2.25, EAST])],
        source: Source::Text(include_str!("../../../maps/lei-map3.txt"), 0.5),
    },
    BuiltinMap {
        name: "wang-aisles",
        about: "20 x 20 cells of 1 m, as in Wang et al. 2019: two barriers whose blocks meet only at \
                their corners. A diagonal step would squeeze through either; whoever may not has to \
                go around.",
        kind: BuiltinKind::GridProblem,
        vehicle: "point",
        requests: &[request("across", [0.5, 19.5, EAST], [19.5, 0.5, EAST])],
        source: Source::Text(include_str!("../../../maps/wang-aisles.txt"), 1.0),
    },
    BuiltinMap {
        name: "wang-open",
        about: "20 x 20 cells of 1 m with scattered blocks and no narrow aisle: all ways between \
                blocks are at least two cells wide.",
        kind: BuiltinKind::GridProblem,
        vehicle: "point",
        requests: &[request("across", [0.5, 19.5, EAST], [19.5, 0.5, EAST])],
        source: Source::Text(include_str!("../../../maps/wang-open.txt"), 1.0),
    },
    BuiltinMap {
        name: "aco20",
        about: "20 x 20 matrix that circulates in MATLAB ACO code (for instance github \
                xuedidi/path_planning); start top left, goal bottom right, cells of 1 m.",
        kind: BuiltinKind::GridProblem,
        vehicle: "point",
        requests: &[request("across", [0.5, 19.5, EAST], [19.5, 0.5, EAST])],
        source: Source::Text(include_str!("../../../maps/aco20.txt"), 1.0),
    },
    BuiltinMap {
        name: "warehouse",
        about: "40 x 25 m at 0.05 m: docks, staging lanes, two tiers of racks with aisles of 1.5 and \
                2.4 m, packing tables, an office, chargers. For warehouse_amr (0.62 x 0.90 m).",
        kind: BuiltinKind::Scene,
        vehicle: "warehouse_amr",
        requests: &[
            request("dock-to-rack", [11.3, 1.2, NORTH], [5.85, 20.0, NORTH]),
            request("rack-to-packing", [13.25, 10.5, SOUTH], [34.3, 11.2, EAST]),
            request("charger-to-dock", [38.6, 14.1, WEST], [23.3, 1.2, NORTH]),
        ],
        source: Source::Drawing(scenes::warehouse),
    },
    BuiltinMap {
        name: "parking-lot",
        about: "60 x 34 m at 0.1 m: four rows of bays of 2.5 x 5.0 m on aisles of 6.0 m, most of them \
                taken. For sedan (1.8 x 4.7 m).",
        kind: BuiltinKind::Scene,
        vehicle: "sedan",
        requests: &[
            request("nose-in", [4.0, 29.0, SOUTH], [29.75, 4.8, SOUTH]),
            request("back-in", [56.0, 3.0, NORTH], [37.25, 18.4, NORTH]),
            request("leave", [17.25, 29.2, NORTH], [4.0, 6.0, SOUTH]),
        ],
        source: Source::Drawing(scenes::parking_lot),
    },
    BuiltinMap {
        name: "neighborhood",
        about: "800 x 500 cells of 0.2 m from the generator of alley neighborhoods: streets with \
                parked cars, alleys of 2 to 4 m, dead ends, yards. For sedan (1.8 x 4.7 m).",
        kind: BuiltinKind::Scene,
        vehicle: "sedan",
        requests: &[
            request("across", [29.2, 3.0, NORTH], [110.0, 86.0, NORTH]),
            request("into-alley", [29.2, 3.0, NORTH], [46.0, 68.1, WEST]),
            request("into-dead-end", [70.0, 94.0, SOUTH], [93.0, 77.0, SOUTH]),
        ],
        source: Source::Drawing(scenes::neighborhood),
    },
    BuiltinMap {
        name: "li-neighborhood",
        about: "800 x 500 cells of 0.2 m for the lei2020 vehicle (1.0 x 3.0 m), the size of the \
                neighborhood in Li et al. 2024, from the generator of alley neighborhoods. The route \
                is 92 m long over cells, most of it in alleys of 3.2 m and less.",
        kind: BuiltinKind::Scene,
        vehicle: "lei2020",
        requests: &[request(
            "route-92m",
            [151.5, 37.5, WEST],
            [97.5, 85.5, NORTH],
        )],
        source: Source::Drawing(scenes::li_neighborhood),
    },
    BuiltinMap {
        name: "narrow-aisle",
        about: "Aisles of 1.1 m between racks, cross aisles of 1.2 m, for warehouse_amr (0.62 x 0.90 \
                m, turning radius 0.77 m): 0.24 m to spare on either side when straight, while the \
                body sweeps 0.87 m in a turn. One aisle is blind.",
        kind: BuiltinKind::Narrow,
        vehicle: "warehouse_amr",
        requests: &[
            request("next-aisle", [0.65, 3.0, NORTH], [2.95, 4.5, SOUTH]),
            request("blind-nose-in", [0.65, 3.0, NORTH], [5.25, 2.4, SOUTH]),
            request("blind-back-in", [0.65, 3.0, NORTH], [5.25, 1.75, NORTH]),
        ],
        source: Source::Drawing(narrow::aisle),
    },
    BuiltinMap {
        name: "narrow-junction",
        about: "A crossing of two corridors of 1.2 m at 90 degrees, for warehouse_amr (0.62 x 0.90 m, \
                turning radius 0.77 m): the quarter turn fits with about 0.1 m to spare, and turning \
                around takes the side arms.",
        kind: BuiltinKind::Narrow,
        vehicle: "warehouse_amr",
        requests: &[
            request("quarter-turn", [3.1, 0.8, NORTH], [1.4, 3.1, WEST]),
            request("turn-around", [3.1, 0.8, NORTH], [3.1, 1.5, SOUTH]),
        ],
        source: Source::Drawing(narrow::junction),
    },
    BuiltinMap {
        name: "u-turn-street",
        about: "Two closed streets for sedan (1.8 x 4.7 m, turning radius 4.0 m, whose U-turn in one \
                go needs 11.0 m between walls): one 7.5 m wide, for a three-point turn, the other 5.6 \
                m wide beside parked cars, 0.9 m more than the car is long, for a turn in many.",
        kind: BuiltinKind::Narrow,
        vehicle: "sedan",
        requests: &[
            request("three-point", [11.0, 3.1, EAST], [5.0, 7.6, WEST]),
            request("beside-parked-cars", [31.0, 5.0, EAST], [25.0, 8.0, WEST]),
        ],
        source: Source::Drawing(narrow::u_turn_street),
    },
    BuiltinMap {
        name: "parallel-parking",
        about: "Two gaps in a row of parked cars beside a lane of 5.0 m, for sedan (1.8 x 4.7 m, \
                turning radius 4.0 m): 6.4 m, about the least for leaving in one go, and 5.9 m, where \
                the car has to shuffle.",
        kind: BuiltinKind::Narrow,
        vehicle: "sedan",
        requests: &[
            request("gap-6.4m", [3.0, 5.2, EAST], [6.85, 2.1, EAST]),
            request("gap-5.9m", [3.0, 5.2, EAST], [17.5, 2.1, EAST]),
            request("leave-5.9m", [17.5, 2.1, EAST], [22.0, 5.2, EAST]),
        ],
        source: Source::Drawing(narrow::parallel_parking),
    },
    BuiltinMap {
        name: "perpendicular-parking",
        about: "One free bay of 2.4 x 5.0 m between parked cars, on an aisle of 5.5 m, for sedan (1.8 \
                x 4.7 m, turning radius 4.0 m): 0.6 m to spare on either side, and no room to swing in \
                nose first in one go.",
        kind: BuiltinKind::Narrow,
        vehicle: "sedan",
        requests: &[
            request("nose-in", [3.0, 8.3, EAST], [12.0, 4.9, SOUTH]),
            request("back-in", [3.0, 8.3, EAST], [12.0, 2.4, NORTH]),
        ],
        source: Source::Drawing(narrow::perpendicular_parking),
    },
    BuiltinMap {
        name: "slalom-poles",
        about: "A hall of 2.4 m with gates of poles, one 0.05 m cell each, for warehouse_amr (0.62 x \
                0.90 m, turning radius 0.77 m): openings of 0.85 m lie left and right in turn, 2.5 m \
                apart. Poles stand 0.45 m apart: a body that is tested at its corners only drives \
                through them. Reverse is not needed.",
        kind: BuiltinKind::Narrow,
        vehicle: "warehouse_amr",
        requests: &[request("slalom", [0.4, 1.3, EAST], [14.8, 1.3, EAST])],
        source: Source::Drawing(narrow::slalom_poles),
    },
];

/// A request between two poses `[x m, y m, heading rad]`.
const fn request(id: &'static str, start: [f64; 3], goal: [f64; 3]) -> BuiltinRequest {
    let [x, y, heading] = start;
    let start = Pose2::new(x, y, heading);
    let [x, y, heading] = goal;
    let goal = Pose2::new(x, y, heading);
    BuiltinRequest { id, start, goal }
}
