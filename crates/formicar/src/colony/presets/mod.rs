//! The colonies of papers, each with every parameter.
//!
//! A value that a paper does not state is derived from its text or chosen; the pages in
//! `references/` mark each one.

mod aco;
mod acof;
mod ant_system;
mod elitist;
mod faco2024;
mod joshy2016;
mod lei2020;
mod max_min;
mod wang2019;
mod zhang2016;

pub use aco::aco;
pub use acof::acof;
pub use ant_system::ant_system;
pub use elitist::elitist;
pub use faco2024::faco2024;
pub use joshy2016::joshy2016;
pub use lei2020::lei2020;
pub use max_min::max_min;
pub use wang2019::wang2019;
pub use zhang2016::zhang2016;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_within_its_ranges() {
        for preset in [
            ant_system(),
            elitist(),
            max_min(),
            lei2020(),
            wang2019(),
            zhang2016(),
            joshy2016(),
            aco(),
            acof(),
        ] {
            preset.check().unwrap();
        }
        faco2024().check().unwrap();
    }
}
