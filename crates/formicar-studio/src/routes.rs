//! The routes of the server.

use crate::catalog::Catalog;
use crate::state::Studio;
use crate::upload::{self, Upload};
use crate::{access, connection};
use axum::extract::multipart::{Multipart, MultipartError};
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{DefaultBodyLimit, Path, State};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::middleware::from_fn_with_state;
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Router, body::Bytes};
use formicar::map::format::{RosMapDescription, ros_png};
use serde::Serialize;
use serde_json::json;
use std::sync::Arc;

/// The page, built from `web/`.
const FILES: [(&str, &str, &str); 3] = [
    (
        "/",
        "text/html; charset=utf-8",
        include_str!("../web/dist/index.html"),
    ),
    (
        "/app.js",
        "text/javascript; charset=utf-8",
        include_str!("../web/dist/app.js"),
    ),
    (
        "/app.css",
        "text/css; charset=utf-8",
        include_str!("../web/dist/app.css"),
    ),
];

/// The largest message from a page, bytes: strokes over a whole map.
const MAX_MESSAGE_BYTES: usize = 32 << 20;

/// The router of all that the studio serves.
pub(crate) fn router(studio: Arc<Studio>) -> Router {
    let limit = DefaultBodyLimit::max(studio.options.limits.max_upload_bytes);
    let mut router = Router::new();
    for (path, kind, text) in FILES {
        router = router.route(
            path,
            get(move || async move { ([(CONTENT_TYPE, kind)], text) }),
        );
    }
    router
        .route("/api/catalog", get(get_catalog))
        .route("/api/maps", post(post_map).layer(limit))
        .route("/maps/{hash}/{file}", get(get_map))
        .route("/ws", get(get_socket))
        .layer(from_fn_with_state(studio.clone(), access::guard))
        .with_state(studio)
}

fn json_response(status: StatusCode, document: &impl Serialize) -> Response {
    let kind = [(CONTENT_TYPE, "application/json")];
    let text = serde_json::to_string(document).expect("documents have text keys");
    (status, kind, text).into_response()
}

async fn get_catalog(State(studio): State<Arc<Studio>>) -> Response {
    json_response(StatusCode::OK, &Catalog::new(&studio.options.limits))
}

async fn get_socket(State(studio): State<Arc<Studio>>, upgrade: WebSocketUpgrade) -> Response {
    let Ok(permit) = studio.clients.clone().try_acquire_owned() else {
        let n = studio.options.limits.max_clients;
        let reason = format!("{n} clients are connected, the most allowed\n");
        return (StatusCode::SERVICE_UNAVAILABLE, reason).into_response();
    };
    upgrade
        .max_message_size(MAX_MESSAGE_BYTES)
        .max_frame_size(MAX_MESSAGE_BYTES)
        .on_upgrade(move |socket| connection::serve(socket, studio, permit))
}

async fn post_map(State(studio): State<Arc<Studio>>, form: Multipart) -> Response {
    let refused = |reason: String| {
        json_response(
            StatusCode::UNPROCESSABLE_ENTITY,
            &json!({ "error": reason }),
        )
    };
    let (files, resolution_m) = match read_form(form).await {
        Ok(read) => read,
        Err(reason) => return refused(reason),
    };
    let max_cells = studio.options.limits.max_cells;
    let kept = tokio::task::spawn_blocking(move || {
        let (name, map) = upload::map(&files, resolution_m, max_cells)?;
        let warnings = map.warnings.iter().map(ToString::to_string).collect();
        studio.maps.keep_file(&name, map.grid, warnings)
    });
    match kept.await {
        Ok(Ok(map)) => json_response(
            StatusCode::OK,
            &json!({ "hash": map.hash, "name": map.name, "warnings": map.warnings }),
        ),
        Ok(Err(reason)) => refused(reason),
        Err(_) => refused("reading the map failed; please report the file".to_owned()),
    }
}

async fn read_form(mut form: Multipart) -> Result<(Vec<Upload>, Option<f64>), String> {
    let failed = |error: MultipartError| format!("the upload: {}", error.body_text());
    let (mut files, mut resolution_m) = (Vec::new(), None);
    while let Some(field) = form.next_field().await.map_err(failed)? {
        let (key, name) = (
            field.name().map(str::to_owned),
            field.file_name().map(str::to_owned),
        );
        let bytes = field.bytes().await.map_err(failed)?;
        match (key.as_deref(), name) {
            (Some("files"), Some(name)) => files.push(Upload { name, bytes }),
            (Some("resolution_m"), _) => resolution_m = Some(number(&bytes)?),
            (key, _) => {
                let key = key.unwrap_or_default();
                return Err(format!(
                    "the upload: unknown part {key:?}; there are files, resolution_m"
                ));
            }
        }
    }
    Ok((files, resolution_m))
}

fn number(bytes: &Bytes) -> Result<f64, String> {
    let text = String::from_utf8_lossy(bytes);
    let number = text.trim().parse::<f64>();
    number.map_err(|_| format!("resolution_m: {text:?} is not a number"))
}

/// A kept map as a ROS map: `map.yaml` and `map.png`.
async fn get_map(
    State(studio): State<Arc<Studio>>,
    Path((hash, file)): Path<(String, String)>,
) -> Response {
    let map = studio.maps.kept(&hash);
    let written = map.and_then(|map| match file.as_str() {
        "map.yaml" => {
            let text = RosMapDescription::of_grid("map.png", &map.grid).to_yaml();
            Some(("application/yaml", text.into_bytes()))
        }
        "map.png" => Some(("image/png", ros_png(&map.grid).ok()?)),
        _ => None,
    });
    written.map_or_else(
        || (StatusCode::NOT_FOUND, "no such map\n").into_response(),
        |(kind, bytes)| ([(CONTENT_TYPE, kind)], bytes).into_response(),
    )
}
