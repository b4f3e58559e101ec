//! A sparse factorization, L D Lᵀ, of symmetric matrices of 3 x 3 blocks, with minimum degree.
//!
//! Left-looking: a column takes what the earlier columns with an entry in its row leave. No
//! pivoting: the matrices are those of least squares, positive definite by their damping.

use super::ordering::Ordering;

/// A 3 x 3 block, row-major.
pub type Block = [f64; 9];

/// A symmetric matrix of 3 x 3 blocks, and room for its factor.
#[derive(Clone, Debug)]
pub struct BlockMatrix {
    ordering: Ordering,
    /// Diagonal blocks, by place.
    diagonal: Vec<Block>,
    /// Blocks below the diagonal, in the columns of the ordering; row block times column block.
    columns: Vec<Vec<Block>>,
}

impl BlockMatrix {
    /// A matrix of zeros.
    pub fn new(ordering: Ordering) -> Self {
        let columns = ordering.columns.iter();
        let columns = columns.map(|column| vec![[0.0; 9]; column.len()]).collect();
        Self {
            diagonal: vec![[0.0; 9]; ordering.place.len()],
            columns,
            ordering,
        }
    }

    /// Sets all blocks to 0.
    pub fn clear(&mut self) {
        self.diagonal.fill([0.0; 9]);
        for column in &mut self.columns {
            column.fill([0.0; 9]);
        }
    }

    /// Adds to the diagonal block of a node.
    pub fn add_diagonal(&mut self, node: usize, block: &Block) {
        let place = self.ordering.place[node] as usize;
        add(&mut self.diagonal[place], block);
    }

    /// Adds the block at row `a`, column `b` of an edge that the ordering knows.
    pub fn add_between(&mut self, a: usize, b: usize, block: &Block) {
        let (row, column) = (self.ordering.place[a], self.ordering.place[b]);
        let (row, column, block) = if row > column {
            (row, column, *block)
        } else {
            (column, row, transposed(block))
        };
        let found = self.ordering.columns[column as usize].binary_search(&row);
        if let Ok(i) = found {
            add(&mut self.columns[column as usize][i], &block);
        }
    }

    /// Scales the diagonal by `1 + damping`, and adds `floor` to it.
    pub fn damp(&mut self, damping: f64, floor: f64) {
        for block in &mut self.diagonal {
            for i in [0, 4, 8] {
                block[i] += damping * block[i] + floor;
            }
        }
    }

    /// Solves for a right-hand side in the order of the nodes, three numbers each. The matrix
    /// becomes its factor.
    ///
    /// None where it is not positive definite.
    pub fn solve(&mut self, right: &[f64]) -> Option<Vec<f64>> {
        let inverses = self.factor()?;
        let n = self.diagonal.len();
        let mut x = vec![[0.0; 3]; n];
        for (node, &place) in self.ordering.place.iter().enumerate() {
            x[place as usize].copy_from_slice(&right[3 * node..3 * node + 3]);
        }
        for column in 0..n {
            let value = x[column];
            for (row, block) in self.entries(column) {
                let product = times_vector(block, value);
                for (r, p) in x[row].iter_mut().zip(product) {
                    *r -= p;
                }
            }
        }
        for (value, inverse) in x.iter_mut().zip(&inverses) {
            *value = times_vector(inverse, *value);
        }
        for column in (0..n).rev() {
            let mut value = x[column];
            for (row, block) in self.entries(column) {
                let product = times_vector(&transposed(block), x[row]);
                for (v, p) in value.iter_mut().zip(product) {
                    *v -= p;
                }
            }
            x[column] = value;
        }
        let places = self.ordering.place.iter();
        Some(places.flat_map(|&place| x[place as usize]).collect())
    }

    fn entries(&self, column: usize) -> impl Iterator<Item = (usize, &Block)> {
        let rows = self.ordering.columns[column].iter();
        rows.map(|&row| row as usize).zip(&self.columns[column])
    }

    /// L in the place of the columns; the inverses of the diagonal blocks of D.
    fn factor(&mut self) -> Option<Vec<Block>> {
        let n = self.diagonal.len();
        let mut inverses = Vec::with_capacity(n);
        // For each row, the columns whose next entry is in it; for each column, that entry.
        let mut waiting: Vec<Vec<u32>> = vec![Vec::new(); n];
        let mut next = vec![0_usize; n];
        let mut index = vec![u32::MAX; n];
        for column in 0..n {
            let rows = &self.ordering.columns[column];
            for (i, &row) in rows.iter().enumerate() {
                index[row as usize] = i as u32;
            }
            let mut own = std::mem::take(&mut self.columns[column]);
            for earlier in std::mem::take(&mut waiting[column]) {
                let earlier = earlier as usize;
                let from = next[earlier];
                let (their_rows, theirs) =
                    (&self.ordering.columns[earlier], &self.columns[earlier]);
                let right = times_transposed(&self.diagonal[earlier], &theirs[from]);
                subtract_product(&mut self.diagonal[column], &theirs[from], &right);
                for (row, block) in their_rows[from + 1..].iter().zip(&theirs[from + 1..]) {
                    let i = index[*row as usize] as usize;
                    subtract_product(&mut own[i], block, &right);
                }
                next[earlier] = from + 1;
                if let Some(&row) = their_rows.get(from + 1) {
                    waiting[row as usize].push(earlier as u32);
                }
            }
            let inverse = inverse(&self.diagonal[column])?;
            for block in &mut own {
                *block = times(block, &inverse);
            }
            if let Some(&row) = rows.first() {
                waiting[row as usize].push(column as u32);
            }
            self.columns[column] = own;
            inverses.push(inverse);
        }
        Some(inverses)
    }
}

fn add(to: &mut Block, block: &Block) {
    for (t, b) in to.iter_mut().zip(block) {
        *t += b;
    }
}

fn transposed(m: &Block) -> Block {
    [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]]
}

fn times(a: &Block, b: &Block) -> Block {
    let mut out = [0.0; 9];
    for i in 0..3 {
        for j in 0..3 {
            out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
        }
    }
    out
}

/// A Bᵀ.
fn times_transposed(a: &Block, b: &Block) -> Block {
    times(a, &transposed(b))
}

fn subtract_product(to: &mut Block, a: &Block, b: &Block) {
    for i in 0..3 {
        for j in 0..3 {
            to[3 * i + j] -= a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
        }
    }
}

fn times_vector(m: &Block, v: [f64; 3]) -> [f64; 3] {
    let row = |i: usize| m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
    [row(0), row(1), row(2)]
}

/// The inverse of a symmetric positive definite block.
fn inverse(m: &Block) -> Option<Block> {
    let sym = crate::matrix::Sym3 {
        xx: m[0],
        xy: m[1],
        xh: m[2],
        yy: m[4],
        yh: m[5],
        hh: m[8],
    };
    let i = sym.inverse()?;
    Some([i.xx, i.xy, i.xh, i.xy, i.yy, i.yh, i.xh, i.yh, i.hh])
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::Seed;
    use proptest::prelude::*;

    /// Gaussian elimination with pivots.
    fn dense_solution(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
        let n = b.len();
        for k in 0..n {
            let pivot = (k..n)
                .max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))
                .unwrap();
            a.swap(k, pivot);
            b.swap(k, pivot);
            let pivot_row = a[k].clone();
            for i in k + 1..n {
                let factor = a[i][k] / pivot_row[k];
                for (value, p) in a[i].iter_mut().zip(&pivot_row).skip(k) {
                    *value -= factor * p;
                }
                b[i] -= factor * b[k];
            }
        }
        for k in (0..n).rev() {
            let known: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
            b[k] = (b[k] - known) / a[k][k];
        }
        b
    }

    proptest! {
        #[test]
        fn equals_a_dense_solver(n in 1..14_usize, seed in 0..1000_u64, extra in 0..12_usize) {
            let mut random = Seed(seed).stream([0, 0]);
            let mut edges: Vec<(usize, usize)> = (1..n).map(|i| (i - 1, i)).collect();
            edges.extend((0..extra).map(|_| (random.below(n), random.below(n))).filter(|(a, b)| a != b));
            let mut matrix = BlockMatrix::new(Ordering::minimum_degree(n, edges.iter().copied()));
            let mut dense = vec![vec![0.0; 3 * n]; 3 * n];
            let mut both = |a: usize, b: usize, block: Block, matrix: &mut BlockMatrix| {
                if a == b { matrix.add_diagonal(a, &block) } else { matrix.add_between(a, b, &block) }
                for i in 0..3 {
                    for j in 0..3 {
                        dense[3 * a + i][3 * b + j] += block[3 * i + j];
                        if a != b {
                            dense[3 * b + j][3 * a + i] += block[3 * i + j];
                        }
                    }
                }
            };
            for node in 0..n {
                both(node, node, [1.0, 0.2, 0.1, 0.2, 1.5, 0.0, 0.1, 0.0, 2.0], &mut matrix);
            }
            for &(a, b) in &edges {
                // J = [A B]: JᵀJ is positive semidefinite.
                let mut random_block = || -> Block { std::array::from_fn(|_| random.range(-1.0, 1.0)) };
                let (ja, jb) = (random_block(), random_block());
                both(a, a, times(&transposed(&ja), &ja), &mut matrix);
                both(b, b, times(&transposed(&jb), &jb), &mut matrix);
                both(a, b, times(&transposed(&ja), &jb), &mut matrix);
            }
            let right: Vec<f64> = (0..3 * n).map(|_| random.range(-1.0, 1.0)).collect();
            let expected = dense_solution(dense, right.clone());
            let found = matrix.solve(&right).unwrap();
            for (a, b) in found.iter().zip(&expected) {
                prop_assert!((a - b).abs() < 1e-8, "{a} {b}");
            }
        }
    }

    #[test]
    fn an_indefinite_matrix_has_no_factor() {
        let mut matrix = BlockMatrix::new(Ordering::minimum_degree(1, std::iter::empty()));
        assert!(matrix.solve(&[1.0; 3]).is_none());
    }
}
