//! The protocol is written down twice: both sides name the same messages with the same fields.

use std::collections::{BTreeMap, BTreeSet};

const SERVER_SIDE: &str = include_str!("../src/protocol.rs");
const PAGE_SIDE: &str = include_str!("../web/src/protocol.ts");

/// Messages by name, with the names of their fields.
type Messages = BTreeMap<String, BTreeSet<String>>;

#[test]
fn page_and_server_list_the_same_messages() {
    let (from_page, from_server) = PAGE_SIDE.split_once("// --- From the server").unwrap();
    let (from_server, _) = from_server.split_once("// --- Over HTTP").unwrap();
    let mut orders = of_enum("enum ClientMessage");
    orders.insert("plan".to_owned(), of_struct("struct PlanOrder"));
    assert_eq!(of_types(from_page), orders);
    let messages = of_enum("enum ServerMessage");
    assert_eq!(of_types(from_server), messages);
    assert!(orders.len() >= 8 && messages.len() >= 14);
}

/// The text of an item of the server's side.
fn block(item: &str) -> &'static str {
    let (_, text) = SERVER_SIDE.split_once(item).unwrap();
    text.split("\n}\n").next().unwrap()
}

/// The variants of an enum.
fn of_enum(item: &str) -> Messages {
    let mut messages = Messages::new();
    let mut name = String::new();
    for line in block(item).lines() {
        let word = word_of(line);
        if line.starts_with("    ") && word.starts_with(char::is_uppercase) {
            name = snake_case(word);
            messages.insert(name.clone(), BTreeSet::new());
        }
        if let (Some(fields), Some(field)) = (messages.get_mut(&name), field_of(line, 8)) {
            fields.insert(field);
        }
    }
    messages
}

/// The fields of a struct.
fn of_struct(item: &str) -> BTreeSet<String> {
    block(item)
        .lines()
        .filter_map(|line| field_of(line, 4))
        .collect()
}

/// The field that is declared on a line with this indentation.
fn field_of(line: &str, indentation: usize) -> Option<String> {
    let declared = line.get(indentation..)?.trim_start_matches("pub(crate) ");
    let word = word_of(declared);
    let is_field = line[..indentation].trim().is_empty() && declared.starts_with(word);
    let is_field = is_field && !word.is_empty() && declared[word.len()..].starts_with(": ");
    is_field.then(|| word.to_owned())
}

fn word_of(text: &str) -> &str {
    let text = text.trim_start();
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_');
    &text[..end.unwrap_or(text.len())]
}

fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(c.to_lowercase());
    }
    snake
}

/// The object types of the page's side that begin with a literal `type`.
fn of_types(text: &str) -> Messages {
    let text = without_comments(text);
    let starts = text.match_indices("type: \"");
    let types = starts.map(|(at, mark)| {
        let name = word_of(&text[at + mark.len()..]);
        (name.to_owned(), members(&text[at..]))
    });
    types.collect()
}

/// The members of the object type that the text begins in, without `type`.
fn members(text: &str) -> BTreeSet<String> {
    let mut depth = 1;
    let mut outer = String::new();
    for c in text.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if depth == 0 {
            break;
        }
        if depth == 1 {
            outer.push(c);
        }
    }
    let declared = outer.split(';').filter_map(|member| member.split_once(':'));
    let names = declared.map(|(name, _)| name.trim().trim_end_matches('?').to_owned());
    names.filter(|name| name != "type").collect()
}

fn without_comments(text: &str) -> String {
    let mut parts = text.split("/*");
    let mut kept = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        kept.push_str(part.split_once("*/").map_or("", |(_, rest)| rest));
    }
    kept
}
