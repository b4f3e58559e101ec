//! A source of scenarios in a campaign file.

use super::mistake::Text;
use anyhow::Result;
use serde::Deserialize;
use std::ops::Range;
use toml::Spanned;

/// A source of scenarios: built-in maps, or a file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScenariosEntry {
    /// Names of built-in maps, `narrow` (the narrow set) or `builtin` (all of them).
    #[serde(default)]
    pub builtin: Vec<Spanned<String>>,
    /// Car scenarios or worlds of BARN (.json), a TPCAP case (.csv) or `MovingAI` scenarios (.scen),
    /// relative to the campaign file.
    pub file: Option<Spanned<String>>,
    /// Some of the scenarios: ids of the file, or requests of the built-in maps.
    pub ids: Option<Vec<Spanned<String>>>,
    /// At most so many, evenly spread from first to last.
    pub limit: Option<Spanned<u32>>,
    /// Side of a cell where the file leaves that open, meters: of TPCAP cases, worlds of BARN, and
    /// maps as text.
    pub resolution_m: Option<Spanned<f64>>,
}

impl ScenariosEntry {
    /// Refuses what cannot stand together, or is out of range.
    pub(super) fn check(&self, span: Range<usize>, text: &Text) -> Result<()> {
        if self.builtin.is_empty() == self.file.is_none() {
            let what = "expected either builtin = [\"MAP\", ...] or file = \"F\"";
            return Err(text.mistake(Some(span), what));
        }
        if let Some(limit) = self.limit.as_ref().filter(|limit| *limit.get_ref() == 0) {
            return Err(text.mistake(Some(limit.span()), "0; expected 1 or more"));
        }
        let side = self.resolution_m.as_ref();
        let wrong = |side: &&Spanned<f64>| !(side.get_ref().is_finite() && *side.get_ref() > 0.0);
        if let Some(side) = side.filter(wrong) {
            let what = format!("{} m; expected a side above 0", side.get_ref());
            return Err(text.mistake(Some(side.span()), what));
        }
        if let Some(side) = side.filter(|_| self.file.is_none()) {
            let what = "built-in maps have their own; hint: leave it out";
            return Err(text.mistake(Some(side.span()), what));
        }
        Ok(())
    }
}
