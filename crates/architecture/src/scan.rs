//! Rust code as the paths that it names.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::BTreeSet;

/// A path as code writes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Path {
    pub(crate) segments: Vec<String>,
    /// The inline modules around it, outermost first.
    pub(crate) inside: Vec<String>,
    /// Whether it stands in code for tests.
    pub(crate) is_test: bool,
    pub(crate) kind: Kind,
}

/// The place of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// In an expression, a type or a pattern.
    Inline,
    /// In a `use` item.
    Import {
        /// The name that it gets; `*` for a glob.
        name: String,
        /// Whether others can name it through this module.
        is_public: bool,
    },
}

/// All that a check needs to know of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scan {
    pub(crate) paths: Vec<Path>,
    /// Modules in files of their own, and whether each is for tests.
    pub(crate) children: Vec<(String, bool)>,
    /// Names of the items of the file.
    pub(crate) items: BTreeSet<String>,
    /// All words outside of `use` items.
    pub(crate) words: BTreeSet<String>,
    /// Names of the macros that are called.
    pub(crate) macros: BTreeSet<String>,
}

impl Scan {
    /// # Panics
    /// On text that is no Rust.
    pub(crate) fn of(text: &str) -> Self {
        let tokens: TokenStream = text.parse().expect("a source file is valid Rust");
        let mut scan = Self::default();
        scan.stream(tokens, &Context::default());
        scan
    }

    fn stream(&mut self, tokens: TokenStream, context: &Context) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut item = Item::default();
        let mut at = 0;
        while at < tokens.len() {
            at += self.token(&tokens[at..], context, &mut item);
        }
    }

    /// Reads what the tokens begin with, and returns how many it took.
    fn token(&mut self, tokens: &[TokenTree], context: &Context, item: &mut Item) -> usize {
        match &tokens[0] {
            TokenTree::Punct(mark) if mark.as_char() == '#' => {
                if let Some(TokenTree::Group(group)) = tokens.get(1) {
                    item.is_test |= group.stream().to_string().replace(' ', "") == "cfg(test)";
                    return 2;
                }
                1
            }
            TokenTree::Punct(mark) => {
                if mark.as_char() == ';' {
                    *item = Item::default();
                }
                1
            }
            TokenTree::Group(group) => {
                let is_test = context.is_test || item.is_test;
                let context = Context {
                    is_test,
                    ..context.clone()
                };
                self.stream(group.stream(), &context);
                if group.delimiter() == Delimiter::Brace {
                    *item = Item::default();
                }
                1
            }
            TokenTree::Ident(word) => self.word(&plain(&word.to_string()), tokens, context, item),
            TokenTree::Literal(_) => 1,
        }
    }

    fn word(
        &mut self,
        word: &str,
        tokens: &[TokenTree],
        context: &Context,
        item: &mut Item,
    ) -> usize {
        let is_test = context.is_test || item.is_test;
        match (word, tokens.get(1)) {
            ("pub", _) => {
                item.is_public = true;
                1 + usize::from(tokens.get(1).is_some_and(is_scope))
            }
            ("use", Some(next)) if !is_mark(next, '<') => {
                let n_tokens = tokens.iter().take_while(|t| !is_mark(t, ';')).count();
                self.import(
                    &tokens[1..n_tokens],
                    &context.with_test(is_test),
                    item.is_public,
                );
                *item = Item::default();
                n_tokens + 1
            }
            ("mod", Some(TokenTree::Ident(name))) => {
                let name = plain(&name.to_string());
                if let Some(TokenTree::Group(group)) = tokens.get(2) {
                    self.stream(group.stream(), &context.within(&name, is_test));
                } else {
                    self.children.push((name, is_test));
                }
                *item = Item::default();
                3
            }
            (
                "struct" | "enum" | "union" | "trait" | "type" | "const" | "static" | "fn",
                Some(TokenTree::Ident(name)),
            ) => {
                self.items.insert(plain(&name.to_string()));
                2
            }
            _ => self.inline_path(tokens, &context.with_test(is_test)),
        }
    }

    /// A path, or a word that stands alone.
    fn inline_path(&mut self, tokens: &[TokenTree], context: &Context) -> usize {
        let mut segments = Vec::new();
        let mut at = 0;
        while let Some(TokenTree::Ident(word)) = tokens.get(at) {
            segments.push(plain(&word.to_string()));
            at += 1;
            if !is_separator(&tokens[at..])
                || !matches!(tokens.get(at + 2), Some(TokenTree::Ident(_)))
            {
                break;
            }
            at += 2;
        }
        if tokens.get(at).is_some_and(|next| is_mark(next, '!')) {
            self.macros.extend(segments.last().cloned());
        }
        self.words.extend(segments.iter().cloned());
        // A path that goes on in braces or angles is taken as far as it goes.
        if segments.len() > 1 || is_separator(&tokens[at..]) || segments[0] == "crate" {
            self.paths.push(Path {
                segments,
                inside: context.inside.clone(),
                is_test: context.is_test,
                kind: Kind::Inline,
            });
        }
        at
    }

    /// The tree of a `use` item, leaf by leaf.
    fn import(&mut self, tree: &[TokenTree], context: &Context, is_public: bool) {
        let mut leaves = Vec::new();
        leaves_of(tree, &[], &mut leaves);
        let paths = leaves.into_iter().map(|(segments, name)| Path {
            segments,
            inside: context.inside.clone(),
            is_test: context.is_test,
            kind: Kind::Import { name, is_public },
        });
        self.paths.extend(paths);
    }
}

/// The surroundings of tokens.
#[derive(Clone, Debug, Default)]
struct Context {
    inside: Vec<String>,
    is_test: bool,
}

impl Context {
    fn with_test(&self, is_test: bool) -> Self {
        Self {
            is_test,
            ..self.clone()
        }
    }

    fn within(&self, module: &str, is_test: bool) -> Self {
        let mut context = self.with_test(is_test);
        context.inside.push(module.to_owned());
        context
    }
}

/// What is known of the item that is being read.
#[derive(Debug, Default)]
struct Item {
    is_public: bool,
    is_test: bool,
}

/// The paths of a `use` tree with the names that they get.
fn leaves_of(tree: &[TokenTree], prefix: &[String], leaves: &mut Vec<(Vec<String>, String)>) {
    let mut segments = prefix.to_vec();
    let mut rest = tree;
    while let Some((first, after)) = rest.split_first() {
        match first {
            TokenTree::Ident(word) if *word == "as" => {
                let name = after.first().map(ToString::to_string).unwrap_or_default();
                return leaves.push((segments, name));
            }
            TokenTree::Ident(word) => segments.push(plain(&word.to_string())),
            TokenTree::Group(group) => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                let branches = inner.split(|token| is_mark(token, ','));
                for branch in branches.filter(|branch| !branch.is_empty()) {
                    leaves_of(branch, &segments, leaves);
                }
                return;
            }
            TokenTree::Punct(mark) if mark.as_char() == '*' => segments.push("*".to_owned()),
            _ => {}
        }
        rest = after;
    }
    // `self` at the end of a branch names the module before it.
    if segments.len() > 1 && segments.last().is_some_and(|last| last == "self") {
        segments.pop();
    }
    let name = segments.last().cloned().unwrap_or_default();
    leaves.push((segments, name));
}

fn is_mark(token: &TokenTree, mark: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == mark)
}

/// Whether a token behind `pub` narrows it, as in `pub(crate)`.
fn is_scope(token: &TokenTree) -> bool {
    let TokenTree::Group(group) = token else {
        return false;
    };
    let first = group.stream().into_iter().next();
    let first = first.map_or(String::new(), |first| first.to_string());
    ["crate", "super", "self", "in"].contains(&first.as_str())
}

fn is_separator(tokens: &[TokenTree]) -> bool {
    matches!(tokens, [a, b, ..] if is_mark(a, ':') && is_mark(b, ':'))
}

/// A word without the mark of a raw identifier.
fn plain(word: &str) -> String {
    word.trim_start_matches("r#").to_owned()
}
