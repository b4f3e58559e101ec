//! Stepping back out of dead ends.

use crate::parameters::parameters;

parameters! {
    /// The ant steps back the way it came, as often as it takes, and never enters the dead end
    /// again. Steps into it and back leave its way, so that a way has no spurs.
    #[derive(Eq)]
    pub struct Retreat {
        /// Steps back that an ant may take in all before it dies.
        pub max_steps: u32 = 1000,
    }
}
