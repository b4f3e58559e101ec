//! `plan --stdin`: a request per line, an answer per line, one warm planner.

use crate::failure::{Ending, Failure};
use crate::output::print_json;
use crate::session::Session;
use anyhow::{Context, Result};
use formicar::numeric::Seed;
use formicar::planner::{Answer, RequestDocument};
use std::io::{BufRead, Read, Write};

/// The longest line that is read, bytes.
const MAX_LINE: u64 = 1 << 20;

/// Answers requests until the input ends. A malformed line gets an answer with the reason.
pub(super) fn run(
    session: &mut Session,
    defaults: &RequestDocument,
    seed: Seed,
    out: &mut impl Write,
) -> Result<Ending, Failure> {
    let mut input = std::io::stdin().lock();
    let mut n_lines = 0;
    while let Some(line) = next_line(&mut input).context("stdin cannot be read")? {
        n_lines += 1;
        if line.trim_ascii().is_empty() {
            continue;
        }
        let answer = match parse(&line) {
            Ok(request) => reply(session, &request, defaults, seed),
            Err(problem) => {
                let reason = format!("line {n_lines}: {problem}");
                let mut answer = session.context().unreadable(reason, seed);
                answer.id = id_of(&line);
                answer
            }
        };
        print_json(out, &answer)?;
        out.flush()?;
    }
    Ok(Ending::Done)
}

fn reply(
    session: &mut Session,
    request: &RequestDocument,
    defaults: &RequestDocument,
    seed: Seed,
) -> Answer {
    let seed = request.seed.map_or(seed, Seed);
    let mut answer = session.ask(request, defaults, seed).answer;
    answer.id.clone_from(&request.id);
    answer
}

fn parse(line: &[u8]) -> Result<RequestDocument, String> {
    if line.len() as u64 > MAX_LINE {
        return Err(format!("more than {MAX_LINE} bytes"));
    }
    let refused = |why: String| {
        format!(
            "not a request: {why}; hint: {{\"start\": [x, y, heading], \"goal\": [x, y, heading]}}"
        )
    };
    // Serde would read a list as the fields in their order, an empty one as all defaults.
    if !line.trim_ascii_start().starts_with(b"{") {
        return Err(refused("it is not a JSON object".to_owned()));
    }
    serde_json::from_slice(line).map_err(|e| refused(e.to_string()))
}

/// The id of a line that is no request, so that the caller can match the answer; also of one that
/// is no JSON, as far as it goes.
fn id_of(line: &[u8]) -> Option<serde_json::Value> {
    const KEY: &[u8] = b"\"id\"";
    if let Ok(value) = serde_json::from_slice::<serde_json::Value>(line) {
        return value.get("id").cloned();
    }
    let at = line.windows(KEY.len()).position(|word| word == KEY)?;
    let rest = line[at + KEY.len()..].trim_ascii_start();
    let rest = rest.strip_prefix(b":")?;
    serde_json::Deserializer::from_slice(rest)
        .into_iter()
        .next()?
        .ok()
}

/// The next line; of a longer one, [`MAX_LINE`] bytes and one more, which shows the excess.
fn next_line(input: &mut impl BufRead) -> std::io::Result<Option<Vec<u8>>> {
    let mut line = Vec::new();
    input
        .by_ref()
        .take(MAX_LINE + 1)
        .read_until(b'\n', &mut line)?;
    if line.is_empty() {
        return Ok(None);
    }
    if line.last() == Some(&b'\n') {
        line.pop();
    } else if line.len() as u64 > MAX_LINE {
        input.skip_until(b'\n')?;
    }
    Ok(Some(line))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_at_line_ends_and_at_the_end() {
        let mut input: &[u8] = b"one\n\ntwo";
        let mut next = || next_line(&mut input).unwrap();
        assert_eq!(next().unwrap(), b"one");
        assert_eq!(next().unwrap(), b"");
        assert_eq!(next().unwrap(), b"two");
        assert_eq!(next(), None);
    }

    #[test]
    fn a_list_is_not_taken_for_a_request() {
        for line in ["[]", "[7, [1, 2, 3], [4, 5, 6]]", "null", "7"] {
            assert!(parse(line.as_bytes()).is_err(), "{line}");
        }
        assert!(parse(b" {}\r").is_ok());
    }

    #[test]
    fn a_bad_line_keeps_its_id() {
        let line = br#"{"id": "a7", "start": "here"}"#;
        assert!(parse(line).is_err());
        assert_eq!(id_of(line), Some("a7".into()));
        assert_eq!(id_of(b"not json"), None);
        assert_eq!(id_of(br#"{"id": 7, "goal": [1, 2,}"#), Some(7.into()));
        assert_eq!(id_of(br#"{"goal": [1, 2], "id":"b" "#), Some("b".into()));
        assert_eq!(id_of(br#"{"id": "#), None);
        assert_eq!(id_of(br#"{"id"#), None);
    }

    #[test]
    fn a_line_beyond_the_limit_is_refused_and_passed_over() {
        let long = vec![b' '; 2 << 20];
        let text = [&long[..], b"\n{}"].concat();
        let mut input = &text[..];
        assert!(parse(&next_line(&mut input).unwrap().unwrap()).is_err());
        assert_eq!(next_line(&mut input).unwrap().unwrap(), b"{}");
    }
}
