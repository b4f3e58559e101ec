//! A family of planners: named sections of parameters, and a search that they configure.

use super::{Abilities, ConfigError, Found, Halt, Hints, PlanError, Task};
use crate::objective::DriveCost;
use crate::path::CurvePath;
use crate::progress::Limits;
#[cfg(feature = "serde")]
use serde_json::{Map, Value};

/// The search of a family, as [`PathSearch`](super::PathSearch) asks for it.
pub(super) trait Family {
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt>;

    fn replan(
        &self,
        task: &mut Task<'_>,
        _previous: &CurvePath,
        _limits: &mut Limits<'_>,
    ) -> Result<Found, Halt> {
        let planner = task.planner().to_owned();
        Err(PlanError::CannotReplan { planner }.into())
    }

    fn abilities(&self) -> Abilities {
        Abilities::default()
    }

    fn hints(&self) -> Hints {
        Hints::default()
    }

    /// Weights of transitions, where a request asks for continuous curvature.
    fn cost(&self) -> &DriveCost;
}

/// The parameters of a family, as sections of a document.
pub(super) trait Sections: Sized {
    /// Names of the sections.
    #[cfg(feature = "serde")]
    const NAMES: &'static [&'static str];

    /// Checks the range of every parameter.
    fn check(&self) -> Result<(), ConfigError>;

    /// These parameters with those sections laid onto them that a document gives; they are taken
    /// out of it.
    #[cfg(feature = "serde")]
    fn laid<E: serde::de::Error>(self, given: &mut Map<String, Value>) -> Result<Self, E>;
}

/// Declares the parameters of a family: a struct of sections, each with parameters of its own.
macro_rules! sections {
    (
        $(#[$about:meta])*
        $config:ident { $($(#[$about_section:meta])* $section:ident: $parameters:ty,)+ }
    ) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[cfg_attr(feature = "schema", schemars(default))]
        pub struct $config {
            $($(#[$about_section])* pub $section: $parameters,)+
        }

        impl $crate::planner::family::Sections for $config {
            #[cfg(feature = "serde")]
            const NAMES: &'static [&'static str] = &[$(stringify!($section)),+];

            fn check(&self) -> Result<(), $crate::planner::ConfigError> {
                $($crate::parameters::Parameters::check(&self.$section)
                    .map_err(|error| error.within(stringify!($section)))?;)+
                Ok(())
            }

            #[cfg(feature = "serde")]
            fn laid<E: serde::de::Error>(
                self,
                given: &mut serde_json::Map<String, serde_json::Value>,
            ) -> Result<Self, E> {
                use $crate::planner::family::laid;
                Ok(Self { $($section: laid(self.$section, stringify!($section), given)?,)+ })
            }
        }
    };
}
pub(super) use sections;

/// The key of the name of a rule, beside the rule's parameters.
#[cfg(feature = "serde")]
const RULE: &str = "rule";

/// A section of the given document, laid onto its defaults.
#[cfg(feature = "serde")]
pub(super) fn laid<T, E>(
    defaults: T,
    section: &'static str,
    given: &mut Map<String, Value>,
) -> Result<T, E>
where
    T: serde::de::DeserializeOwned + serde::Serialize,
    E: serde::de::Error,
{
    let Some(given) = given.remove(section) else {
        return Ok(defaults);
    };
    let fail = |error: serde_json::Error| E::custom(format!("{section}: {error}"));
    let mut whole = serde_json::to_value(defaults).map_err(fail)?;
    lay(given, &mut whole);
    serde_json::from_value(whole).map_err(fail)
}

/// Lays given values onto others, table by table; another rule brings its own parameters.
#[cfg(feature = "serde")]
fn lay(given: Value, onto: &mut Value) {
    match (given, onto) {
        (Value::Object(given), Value::Object(onto)) => {
            if given
                .get(RULE)
                .is_some_and(|rule| onto.get(RULE) != Some(rule))
            {
                onto.clear();
            }
            for (key, value) in given {
                lay(value, onto.entry(key).or_insert(Value::Null));
            }
        }
        (given, onto) => *onto = given,
    }
}
