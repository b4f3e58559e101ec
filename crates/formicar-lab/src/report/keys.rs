//! Names for the numbers of a report, the same on the page and in LaTeX.

use super::{Field, Report, Table};
use std::collections::BTreeSet;

/// Gives each number of a report a name of letters alone, as LaTeX wants it: report, table, row
/// and column. Where two would be the same, later ones end in B, C and so on.
#[derive(Debug, Default)]
pub(super) struct Keys {
    used: BTreeSet<String>,
    report: String,
}

/// A number within its field, and its name.
pub(super) struct NamedPart {
    pub(super) key: String,
    pub(super) text: String,
}

impl Keys {
    pub(super) fn of(report: &Report) -> Self {
        Self {
            used: BTreeSet::new(),
            report: report.name.clone(),
        }
    }

    /// The named numbers of all fields of a table, row by row.
    pub(super) fn name(&mut self, table: &Table) -> Vec<Vec<Vec<NamedPart>>> {
        let rows = table.rows.iter().map(|row| {
            let row_name = row.first().map_or(String::new(), Field::text);
            let fields = row.iter().zip(&table.heading);
            let fields = fields.map(|(field, column)| {
                let parts = field.parts().into_iter().map(|part| NamedPart {
                    key: self.key([&table.key, &row_name, column, part.suffix]),
                    text: part.text,
                });
                parts.collect()
            });
            fields.collect()
        });
        rows.collect()
    }

    fn key(&mut self, words: [&str; 4]) -> String {
        let mut key = letters(&self.report);
        key.extend(words.map(letters));
        if let Some(first) = key.get_mut(..1) {
            first.make_ascii_lowercase();
        }
        let free = |used: &BTreeSet<String>, key: &str| !used.contains(key);
        let key = if free(&self.used, &key) {
            key
        } else {
            let later = ('B'..='Z').map(|letter| format!("{key}{letter}"));
            let longer = (1..).map(|n| format!("{key}{}", "Z".repeat(n)));
            let mut others = later.chain(longer);
            others
                .find(|other| free(&self.used, other))
                .expect("one of endlessly many names is free")
        };
        self.used.insert(key.clone());
        key
    }
}

/// Some words as one, for names of places in a document: small letters, digits and hyphens.
pub(super) fn slug(words: &str) -> String {
    let mut slug = String::new();
    for c in words.chars() {
        if c.is_ascii_alphanumeric() {
            slug.push(c.to_ascii_lowercase());
        } else if !slug.is_empty() && !slug.ends_with('-') {
            slug.push('-');
        }
    }
    let n = slug.trim_end_matches('-').len();
    slug.truncate(n);
    slug
}

/// The letters of some words, each word and each digit beginning with a capital.
fn letters(words: &str) -> String {
    const DIGITS: [&str; 10] = [
        "Zero", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine",
    ];
    let mut name = String::new();
    let mut begins = true;
    for c in words.chars() {
        match (c.to_digit(10), c) {
            (Some(digit), _) => name.push_str(DIGITS[digit as usize]),
            (None, '/') => name.push_str("Over"),
            (None, '>') => name.push_str("Above"),
            (None, c) if c.is_ascii_alphabetic() && begins => name.push(c.to_ascii_uppercase()),
            (None, c) if c.is_ascii_alphabetic() => name.push(c),
            _ => {}
        }
        begins = !c.is_ascii_alphabetic();
    }
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_letters_and_never_twice_the_same() {
        assert_eq!(letters("length / FACO 0-5"), "LengthOverFACOZeroFive");
        let mut table = Table::new("lengths", &["method", "m"]);
        for _ in 0..30 {
            table.row(vec![Field::words("aco"), Field::Number(Some(1.0), 0)]);
        }
        let report = Report {
            name: "li2024".to_owned(),
            ..Report::default()
        };
        let named = Keys::of(&report).name(&table);
        let keys: Vec<&str> = named.iter().map(|row| row[1][0].key.as_str()).collect();
        assert_eq!(keys[0], "liTwoZeroTwoFourLengthsAcoM");
        assert_eq!(keys[1], "liTwoZeroTwoFourLengthsAcoMB");
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), 30);
        let is_word = |key: &&str| key.bytes().all(|b| b.is_ascii_alphabetic());
        assert!(keys.iter().all(is_word), "{keys:?}");
    }
}
