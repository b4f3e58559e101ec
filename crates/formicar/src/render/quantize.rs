//! The colors of many pictures in one palette.

/// Most colors of a palette; one more place is left for another use.
pub(super) const MAX_COLORS: usize = 255;
/// Bits of a channel that tell bins apart.
const BITS: u32 = 5;
const N_BINS: usize = 1 << (3 * BITS);

/// The bin of a color, red first.
pub(super) fn bin(color: [u8; 3]) -> u16 {
    let bits = color.map(|channel| u16::from(channel >> (8 - BITS)));
    bits[0] << (2 * BITS) | bits[1] << BITS | bits[2]
}

/// Counts of colors, in bins of like colors.
pub(super) struct Census {
    counts: Vec<u64>,
    sums: Vec<[u64; 3]>,
}

/// Like colors by their mean.
struct Bin {
    index: usize,
    n: f64,
    mean: [f64; 3],
}

impl Default for Census {
    fn default() -> Self {
        Self {
            counts: vec![0; N_BINS],
            sums: vec![[0; 3]; N_BINS],
        }
    }
}

impl Census {
    /// Counts a color, and tells its bin.
    pub(super) fn count(&mut self, color: [u8; 3]) -> u16 {
        let bin = bin(color);
        self.counts[usize::from(bin)] += 1;
        let sums = &mut self.sums[usize::from(bin)];
        for (sum, channel) in sums.iter_mut().zip(color) {
            *sum += u64::from(channel);
        }
        bin
    }

    /// A palette of at most [`MAX_COLORS`], filled up to 256 places, and the place of each bin.
    ///
    /// The group of bins that is farthest from its mean is cut there, until there are enough.
    pub(super) fn palette(&self) -> (Vec<[u8; 3]>, Vec<u8>) {
        let used = (0..N_BINS).filter(|&i| self.counts[i] > 0);
        let bins = used.map(|index| {
            let n = self.counts[index] as f64;
            let mean = self.sums[index].map(|sum| sum as f64 / n);
            Bin { index, n, mean }
        });
        let mut groups = vec![Group::new(bins.collect())];
        while groups.len() < MAX_COLORS {
            let worst = (0..groups.len()).max_by(|&a, &b| {
                // Of equals the first.
                groups[a].error.total_cmp(&groups[b].error).then(b.cmp(&a))
            });
            match worst {
                Some(worst) if groups[worst].error > 0.0 => {
                    let (low, high) = groups.swap_remove(worst).cut();
                    groups.extend([low, high]);
                }
                _ => break,
            }
        }
        let mut places = vec![0; N_BINS];
        let mut colors = vec![[0; 3]; MAX_COLORS + 1];
        for (place, group) in groups.iter().enumerate() {
            colors[place] = group.mean.map(|channel| channel.round() as u8);
            for bin in &group.bins {
                places[bin.index] = place as u8;
            }
        }
        (colors, places)
    }
}

/// Bins that share a color.
struct Group {
    bins: Vec<Bin>,
    mean: [f64; 3],
    /// The channel along which its colors differ most.
    channel: usize,
    /// Sum of squares along it.
    error: f64,
}

impl Group {
    fn new(bins: Vec<Bin>) -> Self {
        let n: f64 = bins.iter().map(|bin| bin.n).sum();
        let sum = |of: &dyn Fn(&Bin) -> f64| bins.iter().map(|bin| bin.n * of(bin)).sum::<f64>();
        let mean = [0, 1, 2].map(|c| sum(&|bin| bin.mean[c]) / n.max(1.0));
        let errors = [0, 1, 2].map(|c| sum(&|bin| (bin.mean[c] - mean[c]).powi(2)));
        let channel = (1..3).fold(0, |most, c| if errors[c] > errors[most] { c } else { most });
        // A bin alone differs from its mean by rounding at most.
        let error = if bins.len() > 1 { errors[channel] } else { 0.0 };
        Self {
            bins,
            mean,
            channel,
            error,
        }
    }

    /// Both sides of the mean.
    fn cut(self) -> (Self, Self) {
        let (channel, mean) = (self.channel, self.mean[self.channel]);
        let sides = self
            .bins
            .into_iter()
            .partition(|bin| bin.mean[channel] <= mean);
        let (low, high): (Vec<Bin>, Vec<Bin>) = sides;
        (Self::new(low), Self::new(high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colors_stay_as_they_are() {
        let mut census = Census::default();
        let colors = [[255, 255, 255], [12, 40, 99], [200, 0, 7]];
        let bins = colors.map(|color| (0..40).map(|_| census.count(color)).last().unwrap());
        let (palette, places) = census.palette();
        let found = bins.map(|bin| palette[usize::from(places[usize::from(bin)])]);
        assert_eq!(found, colors);
        assert_eq!(palette.len(), 256);
    }

    #[test]
    fn many_colors_stay_close() {
        let mut census = Census::default();
        let colors: Vec<[u8; 3]> = (0..40_u8)
            .flat_map(|i| (0..40_u8).map(move |j| [6 * i, 6 * j, 3 * (i + j)]))
            .collect();
        let bins: Vec<u16> = colors.iter().map(|&color| census.count(color)).collect();
        let (palette, places) = census.palette();
        for (color, bin) in colors.iter().zip(bins) {
            let found = palette[usize::from(places[usize::from(bin)])];
            let far = (0..3).map(|c| color[c].abs_diff(found[c])).max();
            assert!(far < Some(24), "{color:?} {found:?}");
        }
    }
}
