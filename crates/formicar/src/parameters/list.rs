//! The parameters of a document as a list: the one walk of its JSON schema.

use super::range::Range;
use super::schema::{UNIT, range_in};
use schemars::Schema;
use serde_json::Value;

/// A parameter of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its key, dotted as in a configuration file.
    pub key: String,
    /// Its description.
    pub about: String,
    /// The kind of its values.
    pub kind: Kind,
    /// Its unit, if it has one.
    pub unit: Option<String>,
    /// Its range, if it has one; of a list, that of each number.
    pub range: Option<Range>,
    /// The words that it may be, if it is a word.
    pub words: Vec<String>,
    /// Its default, of a parameter of a rule the rule's own; null if there is none.
    pub default: Value,
    /// The slots that it depends on, each with the key of the rule's name and the rule.
    pub rules: Vec<(String, String)>,
}

/// The kinds of parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number.
    Number,
    /// A whole number.
    Integer,
    /// True or false.
    Switch,
    /// One of some words.
    Word,
    /// Any text.
    Text,
    /// A list.
    List,
}

impl Parameter {
    /// The value of the parameter in a document; none where the document leaves it out or uses
    /// another rule.
    pub fn value_in<'a>(&self, document: &'a Value) -> Option<&'a Value> {
        let is_used = |(key, rule): &(String, String)| {
            at(document, key).is_some_and(|name| name == rule.as_str())
        };
        self.rules
            .iter()
            .all(is_used)
            .then(|| at(document, &self.key))?
    }

    /// Whether it names the rule of a slot.
    pub fn is_slot(&self) -> bool {
        self.key.rsplit('.').next() == Some("rule")
    }

    /// The allowed values in words, such as `0 to 1` or `keep, close`; empty where any will do.
    pub fn allowed(&self) -> String {
        let range = self.range.map(|range| range.to_string());
        range.unwrap_or_else(|| self.words.join(", "))
    }
}

/// All parameters of a document, for every rule that its slots may hold, sorted by key.
pub fn list(schema: &Schema) -> Vec<Parameter> {
    let whole = schema.as_value();
    let mut walk = Walk {
        whole,
        parameters: Vec::new(),
    };
    let place = Place {
        key: String::new(),
        default: Value::Null,
        rules: Vec::new(),
    };
    walk.visit(whole, &place);
    walk.parameters.sort_by(|a, b| a.key.cmp(&b.key));
    walk.parameters
}

/// The value at a dotted key.
fn at<'a>(document: &'a Value, key: &str) -> Option<&'a Value> {
    key.split('.')
        .try_fold(document, |value, name| value.get(name))
}

struct Walk<'a> {
    whole: &'a Value,
    parameters: Vec<Parameter>,
}

/// A place in a document.
struct Place {
    key: String,
    /// The default that the sections around it tell.
    default: Value,
    rules: Vec<(String, String)>,
}

impl Place {
    /// The place of a field, whose default is that of its section or else its own.
    fn field(&self, name: &str, schema: &Value) -> Self {
        let dot = if self.key.is_empty() { "" } else { "." };
        let default = self.default.get(name).or(schema.get("default"));
        Self {
            key: format!("{}{dot}{name}", self.key),
            default: default.cloned().unwrap_or_default(),
            rules: self.rules.clone(),
        }
    }

    /// The same place where a slot holds a rule, whose parameters have defaults of their own.
    fn under(&self, tag: &str, rule: &str) -> Self {
        let slot = self.field(tag, &Value::Null).key;
        let mut rules = self.rules.clone();
        rules.push((slot, rule.to_owned()));
        Self {
            key: self.key.clone(),
            default: Value::Null,
            rules,
        }
    }
}

impl Walk<'_> {
    fn visit(&mut self, part: &Value, place: &Place) {
        let part = self.resolved(part);
        let variants = part["oneOf"].as_array();
        if let Some(variants) = variants {
            let variants = variants.iter().map(|variant| self.resolved(variant));
            self.visit_variants(&part, &variants.collect::<Vec<_>>(), place);
        }
        for (name, field) in part["properties"].as_object().into_iter().flatten() {
            self.visit(field, &place.field(name, field));
        }
        let is_section = variants.is_some() || part.get("properties").is_some();
        if !is_section && part["type"] != "object" {
            self.push(&part, place, words_of(&part));
        }
    }

    fn visit_variants(&mut self, part: &Value, variants: &[Value], place: &Place) {
        let words: Vec<String> = variants.iter().flat_map(words_of).collect();
        if !words.is_empty() {
            self.push(part, place, words);
        }
        let tagged = |variant: &Value| {
            let mut fields = variant["properties"].as_object()?.iter();
            fields.find_map(|(tag, field)| Some((tag.clone(), field["const"].as_str()?.to_owned())))
        };
        let rules: Vec<(String, String)> = variants.iter().filter_map(tagged).collect();
        if let Some((tag, _)) = rules.first() {
            let names = rules.iter().map(|(_, rule)| rule.clone()).collect();
            self.push(part, &place.field(tag, &Value::Null), names);
        }
        for variant in variants {
            let fields = variant["properties"].as_object().into_iter().flatten();
            let under = tagged(variant).map(|(tag, rule)| place.under(&tag, &rule));
            let place = under.as_ref().unwrap_or(place);
            for (name, field) in fields.filter(|(_, field)| field.get("const").is_none()) {
                self.visit(field, &place.field(name, field));
            }
        }
    }

    fn push(&mut self, part: &Value, place: &Place, words: Vec<String>) {
        let text = |key: &str| part[key].as_str().map(str::to_owned);
        let bounded = part.get("items").unwrap_or(part);
        self.parameters.push(Parameter {
            key: place.key.clone(),
            about: text("description").unwrap_or_default(),
            kind: kind_of(part, &words),
            unit: text(UNIT),
            range: range_in(bounded),
            words,
            default: place.default.clone(),
            rules: place.rules.clone(),
        });
    }

    /// A part of the schema with what it refers to, and without the choice of leaving it out.
    fn resolved(&self, part: &Value) -> Value {
        let mut merged = part.clone();
        let options = part["anyOf"].as_array().into_iter().flatten();
        let mut options = options.filter(|option| option["type"] != "null");
        let option = options.next().filter(|_| options.next().is_none());
        let reference = part["$ref"].as_str();
        let referred = reference.and_then(|path| self.whole.pointer(path.trim_start_matches('#')));
        for target in [option, referred].into_iter().flatten() {
            let target = self.resolved(target);
            add(&mut merged, &target);
        }
        merged
    }
}

/// Adds what a part of a schema lacks, and properties beside its own.
fn add(part: &mut Value, other: &Value) {
    let (Value::Object(part), Value::Object(other)) = (part, other) else {
        return;
    };
    for (key, value) in other {
        match part.get_mut(key) {
            None => drop(part.insert(key.clone(), value.clone())),
            Some(own) if key == "properties" => add(own, value),
            Some(_) => {}
        }
    }
}

/// The words that a part of a schema stands for.
fn words_of(part: &Value) -> Vec<String> {
    let listed = part["enum"].as_array().into_iter().flatten();
    let words = part.get("const").into_iter().chain(listed);
    words.filter_map(Value::as_str).map(str::to_owned).collect()
}

fn kind_of(part: &Value, words: &[String]) -> Kind {
    let is = |wanted: &str| match &part["type"] {
        Value::Array(types) => types.iter().any(|of| of == wanted),
        of => of == wanted,
    };
    if !words.is_empty() {
        return Kind::Word;
    }
    let kinds = [
        ("integer", Kind::Integer),
        ("number", Kind::Number),
        ("boolean", Kind::Switch),
        ("array", Kind::List),
    ];
    let found = kinds.into_iter().find(|(name, _)| is(name));
    found.map_or(Kind::Text, |(_, kind)| kind)
}
