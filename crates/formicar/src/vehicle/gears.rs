//! The gears that a vehicle may use.

/// The gears that a path may use. Documents say `forward` and `reverse`, and `reverse` stands for
/// both.
///
/// ```
/// use formicar::vehicle::Gears;
///
/// assert_eq!(Gears::default(), Gears::Both);
/// assert_eq!(Gears::Forward.signs(), [1]);
/// assert_eq!(serde_json::to_string(&Gears::Both)?, r#""reverse""#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Gears {
    /// Forward only.
    Forward,
    /// Forward and in reverse, reverse at a penalty.
    #[default]
    #[cfg_attr(feature = "serde", serde(rename = "reverse"))]
    Both,
}

impl Gears {
    /// The word used in documents.
    pub fn name(self) -> &'static str {
        match self {
            Self::Forward => "forward",
            Self::Both => "reverse",
        }
    }

    /// The signs of the allowed gears: +1 forward, -1 reverse.
    pub fn signs(self) -> &'static [i8] {
        match self {
            Self::Forward => &[1],
            Self::Both => &[1, -1],
        }
    }
}
