//! The contents of blocks of houses: yards, nooks, passages, and fronts that stand back.

use super::{Axis, Rect, Side, Town};

/// Least side of a block that can hold a yard, meters.
const MIN_YARD_BLOCK_M: f64 = 15.0;

impl Town<'_> {
    /// Gives each block a yard, a nook, a passage, or nothing but houses.
    pub(super) fn build_blocks(&mut self) {
        for i in 0..self.blocks.len() {
            let block = self.blocks[i];
            let is_large = block.width().min(block.height()) >= MIN_YARD_BLOCK_M;
            if is_large && self.random.unit() < self.parameters.yard_share {
                self.lay_out_yard(block);
                continue;
            }
            match self.random.below(3) {
                0 => self.cut_nook(block),
                1 => self.cut_passage(block),
                _ => {}
            }
        }
    }

    /// A yard behind houses of 4.6 to 6 m depth, with a gateway, a shed and trees.
    fn lay_out_yard(&mut self, block: Rect) {
        let yard = block.inset(self.random.range(4.6, 6.0));
        self.sketch.clear(yard);
        let width = self
            .random
            .range(2.6, 3.4)
            .min(yard.width().min(yard.height()));
        let gateway = self.across_one_side(block, yard, width);
        self.sketch.clear(gateway);
        let shed = [self.random.range(1.5, 2.5), self.random.range(1.5, 2.0)];
        if yard.width().min(yard.height()) > 6.0 {
            self.sketch.fill(Rect::sized(yard.x0, yard.y0, shed));
        }
        for _ in 0..self.random.below(4) {
            let x = self.random.range(yard.x0, yard.x1);
            let y = self.random.range(yard.y0, yard.y1);
            self.sketch.fill(Rect::sized(x, y, [0.4, 0.4]));
        }
    }

    /// A way of `width` meters from a random side of a block to the yard inside.
    fn across_one_side(&mut self, block: Rect, yard: Rect, width: f64) -> Rect {
        let axis = if self.random.unit() < 0.5 {
            Axis::X
        } else {
            Axis::Y
        };
        let (outer, inner) = (axis.turned(block), axis.turned(yard));
        let x0 = self.random.range(inner.x0, inner.x1 - width);
        let (y0, y1) = match self.side() {
            Side::Low => (outer.y0, inner.y0),
            Side::High => (inner.y1, outer.y1),
        };
        axis.turned(Rect::new(x0, y0, x0 + width, y1))
    }

    /// A place beside the way, 2.6 m deep and 6 to 9 m long, where a car may stand.
    fn cut_nook(&mut self, block: Rect) {
        let depth = 2.6_f64.min(0.3 * block.width().min(block.height()));
        let length = self.random.range(6.0, 9.0);
        let inner = block.inset(depth);
        if inner.width().min(inner.height()) < length {
            return;
        }
        let nook = self.across_one_side(block, inner, length);
        self.sketch.clear(nook);
        if depth > 2.0 && self.random.unit() < self.parameters.parked_car_share {
            let middle = [0.5 * (nook.x0 + nook.x1), 0.5 * (nook.y0 + nook.y1)];
            let car = if nook.width() > nook.height() {
                [4.4, 1.7]
            } else {
                [1.7, 4.4]
            };
            let (x, y) = (middle[0] - 0.5 * car[0], middle[1] - 0.5 * car[1]);
            self.sketch.fill(Rect::sized(x, y, car));
        }
    }

    /// A footpath of 1.2 to 1.6 m between houses, through the whole block.
    fn cut_passage(&mut self, block: Rect) {
        let width = self.random.range(1.2, 1.6);
        let [_, passage, _] = self.cut(block, width);
        self.sketch.clear(passage);
    }

    /// Breaks the fronts of blocks into houses that stand back by different amounts.
    pub(super) fn set_back_fronts(&mut self) {
        for i in 0..self.blocks.len() {
            for axis in [Axis::X, Axis::Y] {
                let block = axis.turned(self.blocks[i]);
                self.set_back_side(block, axis, Side::Low);
                self.set_back_side(block, axis, Side::High);
            }
        }
    }

    /// Sets houses back along one side of a block that has been turned to y.
    fn set_back_side(&mut self, block: Rect, axis: Axis, side: Side) {
        let mut y = block.y0;
        while y < block.y1 {
            let house = self.random.range(5.0, 10.0);
            let depth = self.random.range(-0.4, 0.6).max(0.0);
            let (x0, x1) = match side {
                Side::Low => (block.x0, block.x0 + depth),
                Side::High => (block.x1 - depth, block.x1),
            };
            if depth > 0.0 {
                let strip = Rect::new(x0, y, x1, (y + house).min(block.y1));
                self.sketch.clear(axis.turned(strip));
            }
            y += house;
        }
    }
}
