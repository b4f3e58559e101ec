//! The progress of mapping on stderr, and Ctrl-C as an orderly stop.

use formicar_mapping::{Go, Progress};
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether Ctrl-C was pressed. A second time ends the program at once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Watches for Ctrl-C from now on. Where signals cannot be watched, nothing is ever pressed.
    pub(crate) fn watch() -> Self {
        let pressed = Arc::new(AtomicBool::new(false));
        let signal = signal_hook::consts::SIGINT;
        // In this order: the first signal sets the flag, the second finds it set.
        let _ = signal_hook::flag::register_conditional_shutdown(signal, 130, pressed.clone());
        let _ = signal_hook::flag::register(signal, pressed.clone());
        Self(pressed)
    }

    /// True once Ctrl-C was pressed.
    pub(crate) fn is_pressed(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// The answer to a progress function.
    pub(crate) fn go(&self) -> Go {
        if self.is_pressed() { Go::Stop } else { Go::On }
    }
}

/// A bar over scans and the rounds after them.
pub(crate) struct ScanBar {
    bar: ProgressBar,
    interrupt: Interrupt,
}

impl ScanBar {
    /// A bar on stderr, none where stderr is no terminal.
    pub(crate) fn new(interrupt: &Interrupt) -> Self {
        let style = ProgressStyle::with_template("{msg:20} {wide_bar} {pos}/{len}");
        let bar = ProgressBar::new(0);
        Self {
            bar: style.map_or(bar.clone(), |style| bar.with_style(style)),
            interrupt: interrupt.clone(),
        }
    }

    /// Shows a step; the answer is to stop once Ctrl-C was pressed.
    pub(crate) fn show(&self, step: Progress) -> Go {
        let (words, done, all) = match step {
            Progress::Scans(done, all) => ("matching scans", done, all),
            Progress::Loops(done, all) => ("closing loops", done, all),
            Progress::Refinement(done, all) => ("refining", done, all),
            Progress::Occupancy => ("drawing", 1, 1),
        };
        self.bar.set_message(words);
        self.bar.set_length(all as u64);
        self.bar.set_position(done as u64);
        self.interrupt.go()
    }
}

impl Drop for ScanBar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
