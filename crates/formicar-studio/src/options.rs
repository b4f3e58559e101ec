//! The options of the studio: address, access and limits.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::time::Duration;
use thiserror::Error;

/// The options of the studio.
#[derive(Clone, Debug)]
pub struct Options {
    /// The address to listen on; other machines reach it only if it is not a loopback address.
    pub address: IpAddr,
    /// The port; 0 for any that is free.
    pub port: u16,
    /// The token that clients must present; without one, only a loopback address is allowed.
    pub token: Option<String>,
    /// The limits on clients.
    pub limits: Limits,
}

impl Options {
    /// The default port.
    pub const DEFAULT_PORT: u16 = 8484;
    /// The least length of a token.
    pub const MIN_TOKEN_LENGTH: usize = 16;

    /// The address and port to listen on.
    pub fn socket(&self) -> SocketAddr {
        SocketAddr::new(self.address, self.port)
    }

    /// Checks that only authorized clients can connect.
    ///
    /// # Errors
    /// An address that other machines reach without a token, or a token that is too short or does not
    /// fit into a URL.
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

/// The limits on clients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Clients at a time.
    pub max_clients: usize,
    /// Plans at a time; further ones wait in line.
    pub max_plans: usize,
    /// Time limit of a plan.
    pub max_plan: Duration,
    /// Bytes of an upload.
    pub max_upload_bytes: usize,
    /// Cells of a map.
    pub max_cells: usize,
    /// Cells of all uploaded or kept maps together; beyond, the oldest are dropped.
    pub max_kept_cells: usize,
    /// Waiting orders of one client; beyond, its messages are not read.
    pub max_waiting: usize,
    /// Unsent bytes of one client: beyond, frames are left out, and beyond four times as many the
    /// client is disconnected.
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

/// Reasons why the studio cannot be served.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudioError {
    /// An address that other machines reach, without a token.
    #[error(
        "address {address}: other machines can reach it, so a token is needed; hint: --token with at least 16 letters and digits"
    )]
    NeedsToken {
        /// The address.
        address: IpAddr,
    },
    /// A token that is too easy to guess or does not fit into a URL.
    #[error("the token must have at least 16 characters, letters and digits only")]
    BadToken,
    /// The port is taken or reserved.
    #[error("cannot listen on {at}; hint: another --port, or 0 for any")]
    CannotListen {
        /// The address and port.
        at: SocketAddr,
        /// The error of the system.
        source: std::io::Error,
    },
    /// The server failed.
    #[error("the server stopped")]
    Stopped(#[from] std::io::Error),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_loopback_needs_no_token() {
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
