//! Errors in files, with their places.

use crate::map::MapError;
use crate::vehicle::VehicleError;
use std::fmt;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// An error in a file, with the file's name and the place in it where they are known.
#[derive(Debug)]
pub struct FormatError {
    file: Option<PathBuf>,
    place: Option<Place>,
    problem: Box<FormatProblem>,
}

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// A line, counted from 1.
    Line(usize),
    /// A byte, counted from 0.
    Byte(usize),
    /// A value of a list, counted from 1.
    Value(usize),
}

/// The problem with a file or its contents.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FormatProblem {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Read(std::io::Error),
    /// The file cannot be written.
    #[error("cannot be written: {0}")]
    Write(std::io::Error),
    /// The image of a ROS map cannot be read.
    #[error("its image {image} cannot be read: {problem}; hint: {hint}")]
    Image {
        /// The image as the description names it.
        image: String,
        /// The error of the system.
        problem: String,
        /// The image that lies beside the description.
        hint: String,
    },
    /// A raw image whose line ends were changed.
    #[error(
        "the lines of the header end with CR LF, and {found} bytes of image data follow where {needed} are needed; hint: the file was copied as text, copy it as binary"
    )]
    CopiedAsText {
        /// Bytes found.
        found: usize,
        /// Bytes needed.
        needed: usize,
    },
    /// More bytes than any map needs.
    #[error("is longer than {limit} bytes, the limit for this kind of file")]
    TooLong {
        /// Most bytes allowed.
        limit: u64,
    },
    /// Nothing inside.
    #[error("the file is empty; expected {expected}")]
    Empty {
        /// The expected contents.
        expected: &'static str,
    },
    /// Bytes that are no text.
    #[error("not UTF-8 text; expected {expected}")]
    NotText {
        /// The expected contents.
        expected: &'static str,
    },
    /// The first bytes belong to another kind of file.
    #[error("begins with {found:?}; expected {expected}")]
    WrongMagic {
        /// The first bytes.
        found: String,
        /// The expected contents.
        expected: &'static str,
    },
    /// A file name that tells no format.
    #[error("file name extension {extension:?} is not known; known are {known}")]
    UnknownExtension {
        /// The extension found.
        extension: String,
        /// Those that are known.
        known: &'static str,
    },
    /// The data ends too early.
    #[error("cut short: {found} {unit}, but {needed} are needed")]
    Truncated {
        /// The unit that is counted.
        unit: &'static str,
        /// The number found.
        found: usize,
        /// The number needed.
        needed: usize,
    },
    /// More data than the header announces.
    #[error(
        "{n_extra} {unit} too many after the last one; hint: the sizes at the top may be wrong"
    )]
    Trailing {
        /// The unit that is counted.
        unit: &'static str,
        /// The number left over.
        n_extra: usize,
    },
    /// A value that is missing.
    #[error("{thing} is missing; hint: {hint}")]
    Missing {
        /// The name of the value.
        thing: &'static str,
        /// The value to write.
        hint: &'static str,
    },
    /// A value that cannot be.
    #[error("{thing} is {value}; it must be {expected}")]
    BadValue {
        /// The name of the value.
        thing: &'static str,
        /// The value found.
        value: String,
        /// The allowed values.
        expected: String,
    },
    /// Rows of different lengths.
    #[error("{found} cells in this row; the row above it has {expected}")]
    UnequalRows {
        /// Cells in this row.
        found: usize,
        /// Cells in the rows before.
        expected: usize,
    },
    /// A value that the format has no sign for.
    #[error("{n_cells} cells with value {value}, which {format} cannot hold; hint: {hint}")]
    Unrepresentable {
        /// The number of such cells.
        n_cells: usize,
        /// One of the values.
        value: i8,
        /// The format.
        format: &'static str,
        /// The remedy.
        hint: &'static str,
    },
    /// YAML that cannot be read.
    #[error("{0}")]
    Yaml(String),
    /// JSON that cannot be read.
    #[error("{0}")]
    Json(serde_json::Error),
    /// A PNG image that cannot be read or written.
    #[error("PNG: {0}")]
    Png(String),
    /// A map with impossible measures.
    #[error("{0}")]
    Map(MapError),
    /// A vehicle with impossible measures.
    #[error("{0}")]
    Vehicle(VehicleError),
    /// Something wrong with one scenario of several.
    #[error("scenario {id:?}: {problem}")]
    Scenario {
        /// Its name.
        id: String,
        /// The problem with it.
        problem: Box<FormatProblem>,
    },
}

impl FormatError {
    /// The file, where one was read or written.
    pub fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// The place in the file, where it is known.
    pub fn place(&self) -> Option<Place> {
        self.place
    }

    /// The problem.
    pub fn problem(&self) -> &FormatProblem {
        &self.problem
    }

    /// The same error with its file, unless it names one already.
    #[must_use]
    pub fn in_file(mut self, file: &Path) -> Self {
        self.file.get_or_insert_with(|| file.to_path_buf());
        self
    }

    /// The same error with its place, unless it names one already.
    #[must_use]
    pub fn at(mut self, place: Place) -> Self {
        self.place.get_or_insert(place);
        self
    }
}

impl FormatProblem {
    pub(super) fn bad_value(
        thing: &'static str,
        value: impl fmt::Display,
        expected: impl fmt::Display,
    ) -> Self {
        Self::BadValue {
            thing,
            value: excerpt(&value.to_string()),
            expected: expected.to_string(),
        }
    }

    pub(super) fn wrong_magic(bytes: &[u8], expected: &'static str) -> Self {
        if bytes.is_empty() {
            return Self::Empty { expected };
        }
        let found = String::from_utf8_lossy(&bytes[..bytes.len().min(12)]).into_owned();
        Self::WrongMagic { found, expected }
    }

    pub(super) fn at(self, place: Place) -> FormatError {
        FormatError::from(self).at(place)
    }
}

/// The beginning of a text, short enough for a message.
pub(super) fn excerpt(text: &str) -> String {
    const MAX_CHARS: usize = 40;
    let mut short: String = text.chars().take(MAX_CHARS).collect();
    if short.len() < text.len() {
        short.push_str("...");
    }
    if short.is_empty() {
        short.push_str("empty");
    }
    short
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}: ", file.display())?;
        }
        match self.place {
            Some(Place::Line(line)) => write!(f, "line {line}: ")?,
            Some(Place::Byte(byte)) => write!(f, "byte {byte}: ")?,
            Some(Place::Value(value)) => write!(f, "value {value}: ")?,
            None => {}
        }
        write!(f, "{}", self.problem)
    }
}

impl std::error::Error for FormatError {}

impl From<FormatProblem> for FormatError {
    fn from(problem: FormatProblem) -> Self {
        Self {
            file: None,
            place: None,
            problem: Box::new(problem),
        }
    }
}

impl From<MapError> for FormatError {
    fn from(error: MapError) -> Self {
        FormatProblem::Map(error).into()
    }
}
