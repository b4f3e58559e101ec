//! Where the studio listens, whom it lets in, and how much it takes.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::time::Duration;
use thiserror::Error;

/// How the studio is served.
#[derive(Clone, Debug)]
pub struct Options {
    /// Where it listens; others than this machine reach it only where this is no loopback address.
    pub address: IpAddr,
    /// The port; 0 for any that is free.
    pub port: u16,
    /// What a visitor must know; without one only loopback is allowed.
    pub token: Option<String>,
    /// How much it takes.
    pub limits: Limits,
}

impl Options {
    /// The port that the studio has unless told otherwise.
    pub const DEFAULT_PORT: u16 = 8484;
    /// Characters of a token, at least.
    pub const MIN_TOKEN_LENGTH: usize = 16;

    /// Where it listens.
    pub fn socket(&self) -> SocketAddr {
        SocketAddr::new(self.address, self.port)
    }

    /// Whether strangers are kept out.
    ///
    /// # Errors
    /// An address that others reach without a token, or a token that is too short or does not fit
    /// into an address.
    pub fn check(&self) -> Result<(), StudioError> {
        match &self.token {
            None if !self.address.is_loopback() => Err(StudioError::NeedsToken {
                address: self.address,
            }),
            Some(token)
                if token.len() < Self::MIN_TOKEN_LENGTH
                    || !token.bytes().all(|byte| byte.is_ascii_alphanumeric()) =>
            {
                Err(StudioError::BadToken)
            }
            _ => Ok(()),
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            address: Ipv4Addr::LOCALHOST.into(),
            port: Self::DEFAULT_PORT,
            token: None,
            limits: Limits::default(),
        }
    }
}

/// How much the studio takes from its visitors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Visitors at a time.
    pub max_clients: usize,
    /// Plans at a time; more wait for their turn.
    pub max_plans: usize,
    /// After so long a plan ends by itself.
    pub max_plan: Duration,
    /// Bytes of an uploaded map.
    pub max_upload_bytes: usize,
    /// Cells of a map.
    pub max_cells: usize,
    /// Cells of all maps that visitors have uploaded or kept; the oldest are forgotten.
    pub max_kept_cells: usize,
    /// Requests of one visitor that wait; then it is not read from.
    pub max_waiting: usize,
    /// Bytes that wait for one visitor: frames of ants beyond are left out, and who does not take
    /// four times as much is cut off.
    pub max_unsent_bytes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            max_clients: 256,
            max_plans: std::thread::available_parallelism().map_or(2, usize::from),
            max_plan: Duration::from_mins(1),
            max_upload_bytes: 32 << 20,
            max_cells: 1 << 23,
            max_kept_cells: 1 << 26,
            max_waiting: 64,
            max_unsent_bytes: 16 << 20,
        }
    }
}

/// Why the studio cannot be served.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudioError {
    /// An address that others reach, and nothing that keeps strangers out.
    #[error(
        "address {address}: others can reach it, so visitors must know a token; hint: --token with at least 16 letters and digits"
    )]
    NeedsToken {
        /// The address.
        address: IpAddr,
    },
    /// A token that is too easy to guess, or does not fit into an address.
    #[error("the token: at least 16 letters and digits, nothing else")]
    BadToken,
    /// The port is taken, or must not be listened at.
    #[error("cannot listen at {at}; hint: another --port, or 0 for any")]
    CannotListen {
        /// Where.
        at: SocketAddr,
        /// What the system says.
        source: std::io::Error,
    },
    /// Serving failed.
    #[error("the server stopped")]
    Stopped(#[from] std::io::Error),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_loopback_goes_without_a_token() {
        let open = Options {
            address: Ipv4Addr::UNSPECIFIED.into(),
            ..Options::default()
        };
        assert!(Options::default().check().is_ok());
        assert!(matches!(open.check(), Err(StudioError::NeedsToken { .. })));
        let with = |token: &str| Options {
            token: Some(token.to_owned()),
            ..open.clone()
        };
        assert!(matches!(with("short").check(), Err(StudioError::BadToken)));
        assert!(with("0123456789&admin=1").check().is_err());
        assert!(with("0123456789abcdefXYZ").check().is_ok());
    }
}
