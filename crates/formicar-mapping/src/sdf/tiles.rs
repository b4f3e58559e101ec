//! An unbounded lattice of cells, kept in tiles of 32 x 32 where something was written.

use serde::{Deserialize, Serialize};

/// Cells per side of a tile.
pub const TILE: i32 = 32;
const SHIFT: i32 = 5;
const MASK: i32 = TILE - 1;
const CELLS_PER_TILE: usize = (TILE * TILE) as usize;
const NONE: u32 = u32::MAX;
/// Most entries of the directory: 64 MB, a square of 6.5 km at 5 cm. Beyond it, writes are lost and
/// counted.
const MAX_DIRECTORY: i64 = 1 << 24;

/// A cell of the lattice by column and row, of any sign.
pub type Place = (i32, i32);

/// Values on a lattice; cells that were never written hold a blank value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tiles<T> {
    blank: T,
    /// Column and row of the first tile of the directory.
    corner: Place,
    /// Columns and rows of the directory.
    size: Place,
    directory: Vec<u32>,
    cells: Vec<T>,
    n_lost: u64,
}

impl<T: Copy> Tiles<T> {
    /// An empty lattice.
    pub fn new(blank: T) -> Self {
        Self {
            blank,
            corner: (0, 0),
            size: (0, 0),
            directory: Vec::new(),
            cells: Vec::new(),
            n_lost: 0,
        }
    }

    /// Number of tiles.
    pub fn n_tiles(&self) -> usize {
        self.cells.len() / CELLS_PER_TILE
    }

    /// Memory in use, bytes.
    pub fn memory_bytes(&self) -> usize {
        self.cells.len() * size_of::<T>() + self.directory.len() * size_of::<u32>()
    }

    /// Number of writes that fell outside the largest directory.
    pub fn n_lost(&self) -> u64 {
        self.n_lost
    }

    /// The value of a cell.
    #[inline]
    pub fn get(&self, (x, y): Place) -> T {
        match self.offset(x >> SHIFT, y >> SHIFT) {
            Some(offset) => self.cells[offset + inner(x, y)],
            None => self.blank,
        }
    }

    /// The values at `(x, y)`, `(x + 1, y)`, `(x, y + 1)`, `(x + 1, y + 1)`.
    #[inline]
    pub fn quad(&self, (x, y): Place) -> [T; 4] {
        if x & MASK == MASK || y & MASK == MASK {
            return [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|place| self.get(place));
        }
        let Some(offset) = self.offset(x >> SHIFT, y >> SHIFT) else {
            return [self.blank; 4];
        };
        let i = offset + inner(x, y);
        let j = i + TILE as usize;
        [
            self.cells[i],
            self.cells[i + 1],
            self.cells[j],
            self.cells[j + 1],
        ]
    }

    /// Applies a function to the cells of a row from column `from` to column `to`, both included.
    #[inline]
    pub fn update_row(&mut self, y: i32, from: i32, to: i32, mut update: impl FnMut(i32, &mut T)) {
        let mut x = from;
        while x <= to {
            let end = (x | MASK).min(to);
            let Some(offset) = self.made(x >> SHIFT, y >> SHIFT) else {
                self.n_lost += (end - x + 1) as u64;
                x = end + 1;
                continue;
            };
            let first = offset + inner(x, y);
            let last = offset + inner(end, y);
            for (i, cell) in self.cells[first..=last].iter_mut().enumerate() {
                update(x + i as i32, cell);
            }
            x = end + 1;
        }
    }

    /// Applies a function to one cell.
    #[inline]
    pub fn update(&mut self, (x, y): Place, mut update: impl FnMut(&mut T)) {
        self.update_row(y, x, x, |_, cell| update(cell));
    }

    /// Lowest and highest tile in use, in cells: first cell, and one past the last.
    pub fn bounds(&self) -> Option<(Place, Place)> {
        let mut bounds: Option<(Place, Place)> = None;
        for (tile, _) in self.tiles() {
            let next = (tile.0 + TILE, tile.1 + TILE);
            bounds = Some(match bounds {
                None => (tile, next),
                Some((a, b)) => (
                    (a.0.min(tile.0), a.1.min(tile.1)),
                    (b.0.max(next.0), b.1.max(next.1)),
                ),
            });
        }
        bounds
    }

    /// The first cell of every tile and the tile's values, row-major, in the order of the directory.
    pub fn tiles(&self) -> impl Iterator<Item = (Place, &[T])> {
        let used = self.directory.iter().enumerate();
        let used = used.filter(|(_, slot)| **slot != NONE);
        used.map(|(i, &slot)| {
            let (col, row) = (i as i32 % self.size.0, i as i32 / self.size.0);
            let first = ((self.corner.0 + col) * TILE, (self.corner.1 + row) * TILE);
            let from = slot as usize * CELLS_PER_TILE;
            (first, &self.cells[from..from + CELLS_PER_TILE])
        })
    }

    /// Every value with its cell, tile by tile.
    pub fn iter(&self) -> impl Iterator<Item = (Place, T)> {
        self.tiles().flat_map(|(first, values)| {
            values.iter().enumerate().map(move |(i, &value)| {
                let i = i as i32;
                ((first.0 + (i & MASK), first.1 + (i >> SHIFT)), value)
            })
        })
    }

    #[inline]
    fn offset(&self, tile_x: i32, tile_y: i32) -> Option<usize> {
        let (col, row) = (tile_x - self.corner.0, tile_y - self.corner.1);
        if col < 0 || row < 0 || col >= self.size.0 || row >= self.size.1 {
            return None;
        }
        let slot = self.directory[(row * self.size.0 + col) as usize];
        (slot != NONE).then(|| slot as usize * CELLS_PER_TILE)
    }

    /// The offset of a tile, which is made if it does not exist.
    #[inline]
    fn made(&mut self, tile_x: i32, tile_y: i32) -> Option<usize> {
        if let Some(offset) = self.offset(tile_x, tile_y) {
            return Some(offset);
        }
        self.grow(tile_x, tile_y)?;
        let place = (tile_y - self.corner.1) * self.size.0 + (tile_x - self.corner.0);
        let slot = self.n_tiles();
        self.directory[place as usize] = slot as u32;
        self.cells
            .resize(self.cells.len() + CELLS_PER_TILE, self.blank);
        Some(slot * CELLS_PER_TILE)
    }

    /// Widens the directory so that it holds a tile; it grows by a quarter, so that growth is rare.
    fn grow(&mut self, tile_x: i32, tile_y: i32) -> Option<()> {
        let is_empty = self.directory.is_empty();
        let axis = |corner: i32, size: i32, tile: i32| {
            if is_empty {
                return (tile - 4, 9);
            }
            let (low, high) = (corner, corner + size);
            let spare = 4 + size / 4;
            let low = if tile < low { tile - spare } else { low };
            let high = if tile >= high { tile + 1 + spare } else { high };
            (low, high - low)
        };
        let (x, n_cols) = axis(self.corner.0, self.size.0, tile_x);
        let (y, n_rows) = axis(self.corner.1, self.size.1, tile_y);
        if (x, y) == self.corner && (n_cols, n_rows) == self.size {
            return Some(());
        }
        if i64::from(n_cols) * i64::from(n_rows) > MAX_DIRECTORY {
            return None;
        }
        let mut directory = vec![NONE; (n_cols * n_rows) as usize];
        for row in 0..self.size.1 {
            let from = (row * self.size.0) as usize;
            let to = ((row + self.corner.1 - y) * n_cols + self.corner.0 - x) as usize;
            let n = self.size.0 as usize;
            directory[to..to + n].copy_from_slice(&self.directory[from..from + n]);
        }
        self.corner = (x, y);
        self.size = (n_cols, n_rows);
        self.directory = directory;
        Some(())
    }
}

#[inline]
fn inner(x: i32, y: i32) -> usize {
    ((y & MASK) * TILE + (x & MASK)) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    proptest! {
        #[test]
        fn equals_a_table(writes in prop::collection::vec((-200..200_i32, -200..200_i32, 0..90_i32), 1..40)) {
            let mut tiles = Tiles::new(0_u32);
            let mut table = BTreeMap::new();
            for (x, y, n) in writes {
                tiles.update_row(y, x, x + n, |_, cell| *cell += 1);
                for i in x..=x + n {
                    *table.entry((i, y)).or_insert(0) += 1;
                }
            }
            for (&(x, y), &n) in &table {
                prop_assert_eq!(tiles.get((x, y)), n);
                let around = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
                prop_assert_eq!(tiles.quad((x, y)), around.map(|p| *table.get(&p).unwrap_or(&0)));
            }
            let total: u32 = tiles.iter().map(|(_, n)| n).sum();
            prop_assert_eq!(total, table.values().sum::<u32>());
        }
    }

    #[test]
    fn writes_far_apart_are_counted_and_lost() {
        let mut tiles = Tiles::new(0_u8);
        tiles.update((0, 0), |cell| *cell = 1);
        tiles.update((1 << 30, 1 << 30), |cell| *cell = 1);
        assert_eq!((tiles.n_tiles(), tiles.n_lost()), (1, 1));
        assert_eq!(tiles.get((1 << 30, 1 << 30)), 0);
    }
}
