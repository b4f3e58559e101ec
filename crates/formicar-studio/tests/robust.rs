//! Strangers, slow visitors, many visitors, and bad uploads.

use crate::common::{LEI_MAP1, NEIGHBORHOOD, Visitor, get, http, plan, run, studio};
use formicar_studio::{Limits, Options, StudioError, serve};
use serde_json::json;
use std::net::{Ipv4Addr, SocketAddr};

#[test]
fn pages_are_served_under_a_strict_policy() {
    let at = studio(Options::default());
    for (path, holds) in [
        ("/", "<script"),
        ("/app.js", "WebSocket"),
        ("/app.css", ".status-line"),
        ("/api/catalog", "config_schema"),
    ] {
        let answer = get(at, path);
        assert!(answer.starts_with("HTTP/1.1 200"), "{path}: {answer:.200}");
        assert!(
            answer.contains("default-src 'none'; script-src 'self'"),
            "{path}"
        );
        assert!(answer.contains(holds), "{path}");
        // Nothing is asked for elsewhere.
        assert!(
            !answer.contains("src=\"http") && !answer.contains("@import"),
            "{path}"
        );
    }
}

#[test]
fn nothing_but_the_page_can_be_reached() {
    let at = studio(Options::default());
    for path in [
        "/../Cargo.toml",
        "/%2e%2e/Cargo.toml",
        "/maps/..%2f..%2fetc/passwd",
        "/maps/../../etc/passwd",
        "/maps/0/map.yaml",
        "/web/dist/app.js",
    ] {
        assert!(get(at, path).starts_with("HTTP/1.1 404"), "{path}");
    }
    let foreign = "GET /ws HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n";
    assert!(http(at, foreign.as_bytes()).starts_with("HTTP/1.1 403"));
    let elsewhere = format!(
        "GET /ws HTTP/1.1\r\nHost: {at}\r\nOrigin: https://evil.example\r\nConnection: close\r\n\r\n"
    );
    assert!(http(at, elsewhere.as_bytes()).starts_with("HTTP/1.1 403"));
}

#[test]
fn others_than_this_machine_need_a_token() {
    let open = Options {
        address: Ipv4Addr::UNSPECIFIED.into(),
        port: 0,
        ..Options::default()
    };
    let refused = serve(open.clone(), |_| panic!("is not served"));
    assert!(matches!(refused, Err(StudioError::NeedsToken { .. })));
    let at = studio(Options {
        token: Some("0123456789abcdef".to_owned()),
        ..open
    });
    let at = SocketAddr::new(Ipv4Addr::LOCALHOST.into(), at.port());
    assert!(get(at, "/api/catalog").starts_with("HTTP/1.1 401"));
    assert!(get(at, "/api/catalog?token=0123456789abcdef").starts_with("HTTP/1.1 200"));
    // The page asks for its own files with the cookie that came with it.
    let page = get(at, "/?token=0123456789abcdef");
    let (_, cookie) = page.split_once("set-cookie: ").expect("a cookie");
    let cookie = cookie.split(';').next().unwrap_or_default();
    for path in ["/app.js", "/app.css"] {
        let with = |cookie: &str| {
            let head = format!("GET {path} HTTP/1.1\r\nHost: {at}\r\n{cookie}");
            http(at, format!("{head}Connection: close\r\n\r\n").as_bytes())
        };
        assert!(with(&format!("Cookie: {cookie}\r\n")).starts_with("HTTP/1.1 200"));
        assert!(with("").starts_with("HTTP/1.1 401"));
    }
}

/// A form with one file, and perhaps a resolution.
fn upload(at: SocketAddr, name: &str, bytes: &[u8], resolution_m: Option<&str>) -> String {
    let mut body = Vec::new();
    let mut part = |head: &str, bytes: &[u8]| {
        body.extend_from_slice(b"--XX\r\nContent-Disposition: form-data; ");
        body.extend_from_slice(head.as_bytes());
        body.extend_from_slice(b"\r\n\r\n");
        body.extend_from_slice(bytes);
        body.extend_from_slice(b"\r\n");
    };
    part(&format!("name=\"files\"; filename=\"{name}\""), bytes);
    if let Some(resolution_m) = resolution_m {
        part("name=\"resolution_m\"", resolution_m.as_bytes());
    }
    body.extend_from_slice(b"--XX--\r\n");
    let length = body.len();
    let mut request = format!(
        "POST /api/maps HTTP/1.1\r\nHost: {at}\r\nConnection: close\r\nContent-Type: multipart/form-data; boundary=XX\r\nContent-Length: {length}\r\n\r\n"
    )
    .into_bytes();
    request.extend(body);
    http(at, &request)
}

#[test]
fn uploads_are_read_or_refused_with_a_reason() {
    let limits = Limits {
        max_cells: 100,
        max_upload_bytes: 4000,
        ..Limits::default()
    };
    let at = studio(Options {
        limits,
        ..Options::default()
    });
    let map = b"type octile\nheight 2\nwidth 3\nmap\n..@\n...\n";
    let kept = upload(at, "yard.map", map, None);
    let json = kept.split("\r\n\r\n").nth(1).unwrap();
    let kept: serde_json::Value = serde_json::from_str(json).unwrap();
    assert_eq!(kept["name"], "yard.map");
    run(async {
        let mut visitor = Visitor::new(at).await;
        visitor
            .say(&json!({ "type": "open_map", "map": { "hash": kept["hash"] } }))
            .await;
        let map = visitor.wait_for("map").await;
        assert_eq!((&map["n_cols"], &map["n_rows"]), (&json!(3), &json!(2)));
    });
    let large = format!(
        "type octile\nheight 2\nwidth 60\nmap\n{0}\n{0}\n",
        ".".repeat(60)
    );
    for (name, bytes, resolution_m, says) in [
        (
            "yard.map",
            &b"type octile\nheight 2\n"[..],
            None,
            "yard.map",
        ),
        ("yard.exe", b"MZ", None, "exe"),
        ("large.map", large.as_bytes(), None, "at most 100"),
        ("yard.map", map, Some("wide"), "not a number"),
        ("long.map", &[b'.'; 9000], None, ""),
    ] {
        let answer = upload(at, name, bytes, resolution_m);
        assert!(answer.starts_with("HTTP/1.1 4"), "{name}: {answer}");
        assert!(answer.contains(says), "{name}: {answer}");
    }
}

#[test]
fn a_slow_visitor_stalls_nobody() {
    let limits = Limits {
        max_plans: 1,
        max_unsent_bytes: 1 << 16,
        ..Limits::default()
    };
    let at = studio(Options {
        limits,
        ..Options::default()
    });
    run(async {
        // It asks for much and takes nothing.
        let mut slow = Visitor::on(at, "neighborhood").await;
        for number in 1..40 {
            slow.say(&plan(number, "lei2020", NEIGHBORHOOD)).await;
        }
        for _ in 0..3 {
            let mut other = Visitor::on(at, "lei-map1").await;
            other.say(&plan(1, "astar", LEI_MAP1)).await;
            other.wait_for("answer").await;
        }
        // And one that has left in the middle of a plan releases its permit to others.
        drop(slow);
        let mut other = Visitor::on(at, "lei-map1").await;
        other.say(&plan(1, "lei2020", LEI_MAP1)).await;
        assert_eq!(other.wait_for("answer").await["answer"]["status"], "found");
    });
}

#[test]
fn a_hundred_visitors_at_once_are_all_served() {
    let at = studio(Options::default());
    run(async {
        let visits = (0..100).map(|i| {
            tokio::spawn(async move {
                let mut visitor = Visitor::on(at, "lei-map1").await;
                for number in 1..=3 {
                    // Most ask for little, so that what counts is how many they are.
                    let planner = match (i + number) % 10 {
                        0 => "formicar",
                        n if n % 2 == 0 => "astar",
                        _ => "hybrid-astar",
                    };
                    visitor.say(&plan(number as u64, planner, LEI_MAP1)).await;
                    let end = visitor.wait_for("answer").await;
                    assert_eq!(end["plan"], json!(number));
                }
            })
        });
        for visit in visits.collect::<Vec<_>>() {
            visit.await.unwrap();
        }
    });
}

#[test]
fn a_client_beyond_the_limit_is_refused() {
    let limits = Limits {
        max_clients: 2,
        ..Limits::default()
    };
    let at = studio(Options {
        limits,
        ..Options::default()
    });
    run(async {
        let first = Visitor::new(at).await;
        let _second = Visitor::new(at).await;
        let third = tokio_tungstenite::connect_async(format!("ws://{at}/ws")).await;
        assert!(third.is_err());
        drop(first);
        // Its place is free as soon as the server has seen it go.
        while tokio_tungstenite::connect_async(format!("ws://{at}/ws"))
            .await
            .is_err()
        {
            tokio::task::yield_now().await;
        }
    });
}
