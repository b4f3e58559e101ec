//! Access control: the requests that are admitted, and the headers that restrict the page.

use crate::state::Studio;
use axum::extract::{Request, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, COOKIE, HOST, HeaderName, HeaderValue, ORIGIN,
    REFERRER_POLICY, SET_COOKIE, X_CONTENT_TYPE_OPTIONS, X_FRAME_OPTIONS,
};
use axum::http::{HeaderMap, StatusCode, Uri};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::net::IpAddr;
use std::sync::Arc;

/// The content security policy: the page loads its own files and nothing else.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; \
    img-src 'self' data: blob:; connect-src 'self'; manifest-src 'self'; base-uri 'none'; \
    form-action 'none'; frame-ancestors 'none'";

/// Admits or refuses a request, and adds the security headers to every response.
pub(crate) async fn guard(
    State(studio): State<Arc<Studio>>,
    request: Request,
    next: Next,
) -> Response {
    let token = studio.options.token.as_deref();
    let cookie = token.and_then(|token| cookie(request.headers(), request.uri(), token));
    let mut response = match refusal(request.headers(), request.uri(), token) {
        Some((status, reason)) => (status, reason).into_response(),
        None => next.run(request).await,
    };
    let headers = response.headers_mut();
    if let Some(cookie) = cookie {
        headers.append(SET_COOKIE, cookie);
    }
    let added: [(HeaderName, &'static str); 5] = [
        (CONTENT_SECURITY_POLICY, POLICY),
        (X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (X_FRAME_OPTIONS, "DENY"),
        (REFERRER_POLICY, "no-referrer"),
        (CACHE_CONTROL, "no-cache"),
    ];
    for (name, value) in added {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

/// The reason to refuse a request, if there is one.
///
/// With a token, a request that has it is admitted. Without one, only this machine can connect, but
/// a browser on it may send requests for a foreign page: such a page has another origin or, if its
/// name was made to resolve to this machine (DNS rebinding), another host.
fn refusal(
    headers: &HeaderMap,
    uri: &Uri,
    token: Option<&str>,
) -> Option<(StatusCode, &'static str)> {
    let host = headers.get(HOST).and_then(|host| host.to_str().ok());
    let origin = headers.get(ORIGIN).map(|origin| origin.to_str());
    let is_own = match (origin, host) {
        (None, _) => true,
        (Some(Ok(origin)), Some(host)) => origin
            .split_once("://")
            .is_some_and(|(_, named)| named == host),
        _ => false,
    };
    if !is_own {
        return Some((
            StatusCode::FORBIDDEN,
            "only the studio's own page may send requests\n",
        ));
    }
    match token {
        Some(token) if !has_token(headers, uri, token) => Some((
            StatusCode::UNAUTHORIZED,
            "a token is needed; hint: the address that the studio printed\n",
        )),
        None if !host.is_some_and(is_loopback) => Some((
            StatusCode::FORBIDDEN,
            "the studio answers to localhost only\n",
        )),
        _ => None,
    }
}

/// The cookie for a page whose address has the token: the page's own files, which its HTML names
/// without one, are asked for with it.
///
/// Its name has the port, since all studios on a machine share their cookies.
fn cookie(headers: &HeaderMap, uri: &Uri, token: &str) -> Option<HeaderValue> {
    if !has_token(&HeaderMap::new(), uri, token) {
        return None;
    }
    let host = headers.get(HOST).and_then(|host| host.to_str().ok())?;
    let port = host.rsplit_once(':').map_or("", |(_, port)| port);
    let is_port = port.bytes().all(|byte| byte.is_ascii_digit());
    let port = if is_port { port } else { "" };
    let value = format!("{COOKIE_NAME}{port}={token}; Path=/; HttpOnly; SameSite=Strict");
    HeaderValue::try_from(value).ok()
}

/// The beginning of the cookie's name.
const COOKIE_NAME: &str = "formicar_token";

/// Whether a request has the token, in its address or as a cookie of the page.
fn has_token(headers: &HeaderMap, uri: &Uri, token: &str) -> bool {
    let query = uri.query().unwrap_or_default().split('&');
    let cookies = headers.get_all(COOKIE).iter();
    let cookies = cookies.filter_map(|cookies| cookies.to_str().ok());
    let cookies = cookies.flat_map(|cookies| cookies.split(';').map(str::trim));
    let given = query.chain(cookies).filter_map(|pair| pair.split_once('='));
    given
        .filter(|(key, _)| *key == "token" || key.starts_with(COOKIE_NAME))
        .any(|(_, given)| is_same(given.as_bytes(), token.as_bytes()))
}

/// Compares in a time that does not depend on where the two differ.
fn is_same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |all, (x, y)| all | (x ^ y)) == 0
}

/// Whether a host is a loopback name or address.
fn is_loopback(host: &str) -> bool {
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        _ => host,
    };
    let address = name.trim_matches(['[', ']']).parse::<IpAddr>();
    name == "localhost" || address.is_ok_and(|address| address.is_loopback())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(host: &str, origin: Option<&str>, uri: &str, token: Option<&str>) -> u16 {
        let mut headers = HeaderMap::new();
        headers.insert(HOST, host.parse().unwrap());
        if let Some(origin) = origin {
            headers.insert(ORIGIN, origin.parse().unwrap());
        }
        refusal(&headers, &uri.parse().unwrap(), token).map_or(200, |(status, _)| status.as_u16())
    }

    #[test]
    fn foreign_pages_are_refused() {
        for host in [
            "localhost:8484",
            "127.0.0.1:8484",
            "[::1]:8484",
            "localhost",
        ] {
            assert_eq!(status(host, None, "/", None), 200, "{host}");
            let own = format!("http://{host}");
            assert_eq!(status(host, Some(&own), "/ws", None), 200, "{host}");
            assert_eq!(status(host, Some("https://evil.example"), "/ws", None), 403);
            assert_eq!(status(host, Some("null"), "/ws", None), 403);
        }
        assert_eq!(status("evil.example", None, "/", None), 403);
        assert_eq!(status("localhost.evil.example:8484", None, "/", None), 403);
    }

    #[test]
    fn requests_with_the_token_are_admitted() {
        let token = Some("0123456789abcdef");
        let host = "robot.local:8484";
        assert_eq!(status(host, None, "/", token), 401);
        assert_eq!(status(host, None, "/?token=0123456789abcdeg", token), 401);
        assert_eq!(status(host, None, "/ws?token=0123456789abcdef", token), 200);
        assert_eq!(status("localhost", None, "/", token), 401);
    }

    #[test]
    fn the_page_gets_the_token_as_a_cookie() {
        let token = "0123456789abcdef";
        let set = |host: &str, uri: &str| {
            let mut headers = HeaderMap::new();
            headers.insert(HOST, host.parse().unwrap());
            let cookie = cookie(&headers, &uri.parse().unwrap(), token)?;
            Some(cookie.to_str().unwrap().to_owned())
        };
        let page = set("robot.local:8484", "/?token=0123456789abcdef").unwrap();
        assert!(
            page.starts_with("formicar_token8484=0123456789abcdef; "),
            "{page}"
        );
        assert!(
            page.contains("HttpOnly") && page.contains("SameSite=Strict"),
            "{page}"
        );
        assert_eq!(set("robot.local:8484", "/?token=0123456789abcdeg"), None);
        assert_eq!(set("robot.local:8484", "/"), None);
        let mut headers = HeaderMap::new();
        headers.insert(HOST, "robot.local:8484".parse().unwrap());
        headers.insert(COOKIE, page.split(';').next().unwrap().parse().unwrap());
        let uri: Uri = "/app.js".parse().unwrap();
        assert_eq!(refusal(&headers, &uri, Some(token)), None);
        assert!(refusal(&headers, &uri, Some("0123456789abcdeg")).is_some());
    }
}
