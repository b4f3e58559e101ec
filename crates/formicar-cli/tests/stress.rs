//! `stress`: random scenarios, the same for any number of jobs.

use crate::common::Room;

#[test]
fn scenarios_are_the_same_for_any_number_of_jobs_and_one_by_one() {
    let room = Room::new();
    let stress = |more: &[&str]| {
        let budget = ["stress", "--budget", "1000"];
        let run = room.run(&[&budget[..], more].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
        run.stdout
    };
    let one = stress(&["--n", "5", "--seed", "7", "--verbose"]);
    let two = stress(&["--n", "5", "--seed", "7", "--verbose", "--jobs", "2"]);
    assert_eq!(one, two);
    assert!(one.contains("5 scenarios from seed 7: "), "{one}");
    assert!(one.ends_with("no violation\n"), "{one}");
    let alone = stress(&["--n", "1", "--seed", "9", "--verbose"]);
    let line = |text: &str| {
        text.lines()
            .find(|l| l.starts_with("seed 9: "))
            .map(str::to_owned)
    };
    assert_eq!(line(&alone), line(&one));
    assert!(line(&one).is_some());
}

#[test]
fn what_cannot_be_is_told_with_its_seed() {
    let room = Room::new();
    // A planner for points refuses every car: nobody asked for that.
    room.run(&["stress", "--n", "0"]).assert_refused(&["--n"]);
    room.run(&["stress", "--planner", "ants"])
        .assert_refused(&["ants", "formicar"]);
    room.run(&["stress", "--set", "drive.beta=-1"])
        .assert_refused(&["drive.beta"]);
}
