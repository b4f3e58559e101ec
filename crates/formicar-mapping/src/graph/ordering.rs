//! Minimum degree: the order of elimination that keeps a factor sparse.

use std::collections::BTreeSet;

/// An order of elimination, and the columns of the factor that it leads to.
#[derive(Clone, Debug, PartialEq)]
pub struct Ordering {
    /// The place of each node in the order.
    pub place: Vec<u32>,
    /// For each place, the later places that its column of the factor has.
    pub columns: Vec<Vec<u32>>,
}

impl Ordering {
    /// Eliminates the node with the fewest neighbors first; ties go to the lower number.
    ///
    /// Joining the neighbors of an eliminated node gives the columns of the factor on the way.
    pub fn minimum_degree(n_nodes: usize, edges: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut neighbors: Vec<Vec<u32>> = vec![Vec::new(); n_nodes];
        for (a, b) in edges.filter(|(a, b)| a != b) {
            neighbors[a].push(b as u32);
            neighbors[b].push(a as u32);
        }
        for list in &mut neighbors {
            list.sort_unstable();
            list.dedup();
        }
        let degree = |list: &Vec<u32>| list.len() as u32;
        let mut queue: BTreeSet<(u32, u32)> = (0..n_nodes)
            .map(|node| (degree(&neighbors[node]), node as u32))
            .collect();
        let mut place = vec![0; n_nodes];
        let mut columns = Vec::with_capacity(n_nodes);
        let mut merged = Vec::new();
        while let Some((_, node)) = queue.pop_first() {
            place[node as usize] = columns.len() as u32;
            let clique = std::mem::take(&mut neighbors[node as usize]);
            for &other in &clique {
                let list = &mut neighbors[other as usize];
                queue.remove(&(list.len() as u32, other));
                join(list, &clique, [node, other], &mut merged);
                std::mem::swap(list, &mut merged);
                queue.insert((list.len() as u32, other));
            }
            columns.push(clique);
        }
        for column in &mut columns {
            for row in column.iter_mut() {
                *row = place[*row as usize];
            }
            column.sort_unstable();
        }
        Self { place, columns }
    }

    /// Number of blocks below the diagonal.
    pub fn n_blocks(&self) -> usize {
        self.columns.iter().map(Vec::len).sum()
    }
}

/// The union of two sorted lists without two nodes.
fn join(a: &[u32], b: &[u32], without: [u32; 2], out: &mut Vec<u32>) {
    out.clear();
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let next = match (a.get(i), b.get(j)) {
            (Some(&x), Some(&y)) if x < y => x,
            (Some(_) | None, Some(&y)) => y,
            (Some(&x), None) => x,
            (None, None) => break,
        };
        i += usize::from(a.get(i) == Some(&next));
        j += usize::from(b.get(j) == Some(&next));
        if !without.contains(&next) {
            out.push(next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_fills_nothing_and_a_ring_little() {
        let chain = Ordering::minimum_degree(50, (1..50).map(|i| (i - 1, i)));
        assert_eq!(chain.n_blocks(), 49);
        let ring = Ordering::minimum_degree(50, (0..50).map(|i| (i, (i + 1) % 50)));
        assert!(ring.n_blocks() < 100, "{}", ring.n_blocks());
        let mut places = ring.place.clone();
        places.sort_unstable();
        assert!(places.iter().enumerate().all(|(i, &p)| i == p as usize));
    }
}
