//! Always the same share.

use crate::parameters::parameters;

parameters! {
    /// A constant rho (Dorigo, Maniezzo & Colorni 1996).
    pub struct Constant {
        /// Share that evaporates.
        #[range(0.0..=1.0)]
        pub rho: f64 = 0.5,
    }
}
