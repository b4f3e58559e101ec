//! Runs of one method, and what they come to.

use super::drive::Drive;
use crate::analysis::statistics::{quantile, quartiles};
use crate::report::Field;

/// Runs that belong together.
#[derive(Clone, Debug)]
pub(super) struct Group<'a>(Vec<&'a Drive>);

impl<'a> Group<'a> {
    /// The runs of a method in a part of the experiment.
    pub(super) fn new(drives: &'a [Drive], part: &str, method: &str) -> Self {
        let belongs = |drive: &&Drive| drive.part == part && drive.method == method;
        Self(drives.iter().filter(belongs).collect())
    }

    /// Those of them on a ground.
    pub(super) fn on(&self, ground: &str) -> Self {
        let here = self.0.iter().filter(|drive| drive.ground == ground);
        Self(here.copied().collect())
    }

    /// Those of them on grounds whose name begins so.
    pub(super) fn starting(&self, name: &str) -> Self {
        let here = self.0.iter().filter(|drive| drive.ground.starts_with(name));
        Self(here.copied().collect())
    }

    pub(super) fn runs(&self) -> &[&'a Drive] {
        &self.0
    }

    /// The values of those that have one.
    pub(super) fn values(&self, of: impl Fn(&Drive) -> Option<f64>) -> Vec<f64> {
        self.0.iter().filter_map(|drive| of(drive)).collect()
    }

    pub(super) fn median(&self, of: impl Fn(&Drive) -> Option<f64>) -> Option<f64> {
        quantile(&self.values(of), 0.5)
    }

    pub(super) fn mean(&self, of: impl Fn(&Drive) -> Option<f64>) -> Option<f64> {
        let values = self.values(of);
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    }

    /// Median and quartiles as a field.
    pub(super) fn spread(&self, of: impl Fn(&Drive) -> Option<f64>, n_decimals: usize) -> Field {
        Field::Spread(quartiles(&self.values(of)), n_decimals)
    }

    /// How many are certified.
    pub(super) fn certified(&self) -> Field {
        let n_certified = self.0.iter().filter(|drive| drive.certified).count();
        Field::Rate(n_certified, self.0.len())
    }
}

/// One number over another.
pub(super) fn ratio(value: Option<f64>, to: Option<f64>) -> Option<f64> {
    let ratio = value? / to?;
    ratio.is_finite().then_some(ratio)
}
