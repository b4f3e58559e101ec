//! The studio: a page on this machine that shows ants at work and lets users edit maps and drive
//! paths.
//!
//! One server, many clients. [`serve`] gives each client a thread that carries out its orders in
//! turn, a queue of messages that never delays a plan, and planners that stay prepared. A newer
//! plan cancels an older one. The page is built from `web/` and is part of this crate, so that
//! cargo alone builds the studio.

mod access;
mod catalog;
mod command_line;
mod connection;
mod maps;
mod options;
mod outbox;
mod plan_observer;
mod plan_slot;
mod planner_cache;
mod protocol;
mod routes;
mod scene;
mod session;
mod state;
mod upload;
mod wanted;

pub use options::{Limits, Options, StudioError};

use state::Studio;
use std::sync::Arc;

/// Serves the studio until the program is interrupted. `ready` gets the address of the page once
/// it can be opened.
///
/// # Errors
/// Options that admit anyone, or an address that the server cannot listen on.
pub fn serve(options: Options, ready: impl FnOnce(&str)) -> Result<(), StudioError> {
    options.check()?;
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        // A thread for each client, and some for uploads.
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
    // Nobody waits for the plans under way.
    runtime.shutdown_background();
    ended
}
