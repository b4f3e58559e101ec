//! The studio: a page on this machine that shows ants at work, lets maps be touched and paths be
//! driven.
//!
//! One server, many visitors. Each has a thread that does what it asks for in order ([`serve`]
//! starts it), a queue of messages that waits for it and never makes a plan wait, and planners that
//! stay warm. A plan stops when a newer one is asked for. The page itself is built from `web/` and
//! lies in this crate, so that no tool but cargo is needed.

mod catalog;
mod command;
mod desks;
mod gate;
mod ground;
mod maps;
mod options;
mod outbox;
mod protocol;
mod routes;
mod session;
mod upload;
mod visit;
mod warm;
mod watcher;

pub use options::{Limits, Options, StudioError};

use desks::Desks;
use maps::MapShelf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use visit::Seat;
use warm::WarmShelf;

/// What all visitors share.
struct Studio {
    options: Options,
    maps: MapShelf,
    desks: Desks,
    warm: WarmShelf,
    n_clients: AtomicUsize,
}

impl Studio {
    fn new(options: Options) -> Self {
        Self {
            maps: MapShelf::new(options.limits),
            desks: Desks::new(options.limits.max_plans),
            warm: WarmShelf::default(),
            n_clients: AtomicUsize::new(0),
            options,
        }
    }

    /// A place for one more visitor; none where all are taken.
    fn seat(self: &Arc<Self>) -> Option<Seat> {
        let max = self.options.limits.max_clients;
        let more = |n: usize| (n < max).then_some(n + 1);
        let (set, fetch) = (Ordering::Relaxed, Ordering::Relaxed);
        let taken = self.n_clients.fetch_update(set, fetch, more);
        taken.is_ok().then(|| Seat(self.clone()))
    }
}

/// Serves the studio until the program is interrupted. `ready` hears the address of the page when
/// it can be opened.
///
/// # Errors
/// Options that let strangers in, or an address that cannot be listened at.
pub fn serve(options: Options, ready: impl FnOnce(&str)) -> Result<(), StudioError> {
    options.check()?;
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        // A thread for each visitor, and some to read uploads.
        .max_blocking_threads(options.limits.max_clients + 4)
        .enable_all()
        .build()?;
    let ended = runtime.block_on(async {
        let at = options.socket();
        let listener = tokio::net::TcpListener::bind(at).await;
        let listener = listener.map_err(|source| StudioError::CannotListen { at, source })?;
        let token = options.token.as_ref();
        let query = token.map_or(String::new(), |token| format!("?token={token}"));
        let address = listener.local_addr()?;
        let router = routes::router(Arc::new(Studio::new(options)));
        ready(&format!("http://{address}/{query}"));
        tokio::select! {
            served = async { axum::serve(listener, router).await } => served?,
            _ = tokio::signal::ctrl_c() => {}
        }
        Ok(())
    });
    // Plans under way are for nobody.
    runtime.shutdown_background();
    ended
}
