//! Mistakes in a file, with their place.

use anyhow::anyhow;
use std::fmt::Display;
use std::ops::Range;

/// A text with its name, so that what is wrong in it can be pointed at.
#[derive(Clone, Debug, Default)]
pub struct Text {
    /// The name of its file.
    pub name: String,
    /// All of it.
    pub text: String,
}

impl Text {
    /// A mistake at a place: file, line, key, and the matter itself.
    pub fn mistake(&self, span: Option<Range<usize>>, what: impl Display) -> anyhow::Error {
        let Some(span) = span else {
            return anyhow!("{}: {what}", self.name);
        };
        let line = self.line_of(&span);
        let key = self.key_at(line);
        let key = key.map_or(String::new(), |key| format!(", {key}"));
        anyhow!("{}, line {line}{key}: {what}", self.name)
    }

    /// A syntax or type error of TOML, at its place.
    pub fn refused(&self, error: &toml::de::Error) -> anyhow::Error {
        let what = error.message().replace('\n', " ");
        let key = error.span().map(|span| self.key_at(self.line_of(&span)));
        let list = list_of(key.flatten().unwrap_or_default());
        let what = what.trim().replace("expected a sequence", &list);
        self.mistake(error.span(), what)
    }

    /// The line that a place is in, from 1 on.
    fn line_of(&self, span: &Range<usize>) -> usize {
        let before = &self.text[..span.start.min(self.text.len())];
        before.matches('\n').count() + 1
    }

    /// The key that a line sets or, inside a list over several lines, the one before it that does.
    fn key_at(&self, line: usize) -> Option<&str> {
        let lines: Vec<&str> = self.text.lines().take(line).collect();
        lines.iter().rev().find_map(|line| {
            let line = line.trim();
            if line.starts_with('[') && line.ends_with(']') && !line.contains(['"', ',']) {
                return Some(line);
            }
            let (key, _) = line.split_once('=')?;
            let key = key.trim();
            // A string of a list may look like a key, but for its quotation mark.
            let is_key = |c: char| c.is_alphanumeric() || "._-".contains(c);
            (!key.is_empty() && key.chars().all(is_key)).then_some(key)
        })
    }
}

/// The form of the list of a key.
fn list_of(key: &str) -> String {
    let item = match key {
        "builtin" => "\"MAP\"",
        "ids" => "\"ID\"",
        "vehicles" => "\"own\"",
        "set" => "\"KEY=VALUE\"",
        "command" => "\"PROGRAM\"",
        table if table.starts_with('[') => {
            return format!("expected a list of tables; hint: [{table}]");
        }
        _ => "\"WORD\"",
    };
    format!("expected a list, [{item}, ...]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_line_and_key() {
        let text = Text {
            name: "a.toml".to_owned(),
            text: "x = 1\nlist = [\n  \"b=1\",\n]\n[[planner]]\n".to_owned(),
        };
        let told = |at: usize| text.mistake(Some(at..at), "no").to_string();
        assert_eq!(told(4), "a.toml, line 1, x: no");
        assert_eq!(told(17), "a.toml, line 3, list: no");
        assert_eq!(told(28), "a.toml, line 5, [[planner]]: no");
        assert_eq!(text.mistake(None, "no").to_string(), "a.toml: no");
    }
}
