//! Files that use each other in a circle.

use crate::source::Crate;

/// The circles among the files of a crate, tests aside: each as the names of its files.
pub fn circles(source: &Crate) -> Vec<Vec<String>> {
    let n = source.files.len();
    let uses: Vec<Vec<usize>> = (0..n)
        .map(|at| {
            if source.is_test(at) {
                Vec::new()
            } else {
                source.used_by(at)
            }
        })
        .collect();
    let reached: Vec<Vec<bool>> = (0..n).map(|from| reached_from(from, &uses)).collect();
    let mut is_known = vec![false; n];
    let mut circles = Vec::new();
    for at in 0..n {
        if is_known[at] || !reached[at][at] {
            continue;
        }
        let circle: Vec<usize> = (0..n)
            .filter(|&other| reached[at][other] && reached[other][at])
            .collect();
        for &member in &circle {
            is_known[member] = true;
        }
        circles.push(
            circle
                .into_iter()
                .map(|at| source.files[at].name.clone())
                .collect(),
        );
    }
    circles
}

/// The files that can be reached in at least one step.
fn reached_from(from: usize, uses: &[Vec<usize>]) -> Vec<bool> {
    let mut is_reached = vec![false; uses.len()];
    let mut open = vec![from];
    while let Some(at) = open.pop() {
        for &next in &uses[at] {
            if !is_reached[next] {
                is_reached[next] = true;
                open.push(next);
            }
        }
    }
    is_reached
}
