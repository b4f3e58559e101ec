//! The macros that declare parameters.

/// Declares a struct of parameters: per field its documentation, its range, its type and its
/// default.
///
/// ```text
/// parameters! {
///     /// A constant share (Dorigo, Maniezzo & Colorni 1996).
///     pub struct Constant where check_more {
///         /// Share that evaporates.
///         #[range(0.0..=1.0)]
///         pub rho: f64 = 0.5,
///     }
/// }
/// ```
///
/// It writes the struct, its `Default` where the defaults are given, its form in documents, its
/// ranges in the JSON schema and in rustdoc, and `check`. Checks of several parameters together
/// are a method named after `where`. A field without a range must be [`Parameters`] itself.
///
/// [`Parameters`]: super::Parameters
macro_rules! parameters {
    (
        $(#[$meta:meta])*
        pub struct $name:ident $(where $together:ident)? {
            $(
                $(#[doc $doc:tt $text:tt])*
                $(#[range($range:expr)])?
                $(#[serde $serde:tt])?
                pub $field:ident: $type:ty $(= $default:expr)?,
            )*
        }
    ) => {
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
        #[cfg_attr(feature = "schema", schemars(transform = Self::describe))]
        $(#[$meta])*
        pub struct $name {
            $(
                $(#[doc $doc $text])*
                $(#[cfg_attr(doc, doc = concat!("\n\nRange: `", stringify!($range), "`."))])?
                $(#[cfg_attr(feature = "serde", serde $serde)])?
                pub $field: $type,
            )*
        }

        $crate::parameters::parameters!(@default $name { $($field $(= $default)?,)* });

        impl $name {
            /// Checks every parameter.
            ///
            /// # Errors
            /// The first parameter outside its range, with its key dotted from here.
            pub fn check(&self) -> Result<(), $crate::parameters::OutOfRange> {
                $($crate::parameters::parameters!(@check self $field $type $(, $range)?);)*
                $(self.$together()?;)?
                Ok(())
            }

            /// Adds ranges and units to the JSON schema.
            #[cfg(feature = "schema")]
            fn describe(schema: &mut schemars::Schema) {
                $($(
                    let range = $crate::parameters::Range::of::<$type>($range);
                    let key = $crate::parameters::parameters!(@key $field);
                    $crate::parameters::describe(schema, key, range);
                )?)*
                let _ = schema;
            }
        }

        impl $crate::parameters::Parameters for $name {
            fn check(&self) -> Result<(), $crate::parameters::OutOfRange> {
                self.check()
            }
        }
    };
    (@check $self:ident $field:ident $type:ty) => {
        $crate::parameters::Parameters::check(&$self.$field).map_err(|error| {
            error.within($crate::parameters::parameters!(@key $field))
        })?
    };
    (@check $self:ident $field:ident $type:ty, $range:expr) => {
        $crate::parameters::Range::of::<$type>($range)
            .check($crate::parameters::parameters!(@key $field), &$self.$field)?
    };
    (@key $field:ident) => { stringify!($field).trim_start_matches("r#") };
    (@default $name:ident { $($field:ident,)+ }) => {};
    (@default $name:ident { $($field:ident = $default:expr,)* }) => {
        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }
    };
}

/// Declares a slot: an enum of rules, of which those with parameters hold them in a struct.
///
/// In documents a rule is a table whose key `rule` names it, with its parameters beside.
macro_rules! rules {
    (
        $(#[$meta:meta])*
        pub enum $name:ident {
            $($(#[$about:meta])* $rule:ident $(($parameters:ty))?,)*
        }
    ) => {
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[cfg_attr(feature = "serde", serde(tag = "rule", rename_all = "kebab-case"))]
        $(#[$meta])*
        pub enum $name {
            $($(#[$about])* $rule $(($parameters))?,)*
        }

        impl $crate::parameters::Parameters for $name {
            fn check(&self) -> Result<(), $crate::parameters::OutOfRange> {
                $($crate::parameters::rules!(@check self $rule $($parameters)?);)*
                Ok(())
            }
        }
    };
    (@check $self:ident $rule:ident) => {};
    (@check $self:ident $rule:ident $parameters:ty) => {
        if let Self::$rule(rule) = $self {
            return $crate::parameters::Parameters::check(rule);
        }
    };
}

pub(crate) use {parameters, rules};

#[cfg(test)]
#[allow(unreachable_pub, reason = "the macros declare what users see")]
mod tests {
    use crate::parameters::Parameters;

    parameters! {
        /// A share, and a rule.
        pub struct Sample where check_together {
            /// The least share.
            #[range(0.0..=1.0)]
            pub low: f64 = 0.25,
            /// The most.
            #[range(0.0..=1.0)]
            pub high: f64 = 0.5,
            /// Something else.
            pub slot: Slot = Slot::None,
        }
    }

    parameters! {
        /// A count.
        pub struct Count {
            /// Moves.
            #[range(1..=9)]
            pub r#move: u32 = 3,
        }
    }

    rules! {
        /// Rules.
        pub enum Slot {
            /// Nothing.
            None,
            /// Counts.
            Count(Count),
        }
    }

    impl Sample {
        fn check_together(&self) -> Result<(), crate::parameters::OutOfRange> {
            crate::parameters::Range::of::<f64>(self.low..=1.0).check("high", &self.high)
        }
    }

    #[test]
    fn checks_fields_rules_and_what_belongs_together() {
        let message = |sample: Sample| sample.check().map_err(|error| error.to_string());
        assert_eq!(message(Sample::default()), Ok(()));
        let low = Sample {
            low: -0.1,
            ..Sample::default()
        };
        let error = "low = -0.1; it must be in 0 to 1".to_owned();
        assert_eq!(message(low), Err(error));
        let high = Sample {
            high: 0.125,
            ..Sample::default()
        };
        let error = "high = 0.125; it must be in 0.25 to 1".to_owned();
        assert_eq!(message(high), Err(error));
        let slot = Slot::Count(Count { r#move: 10 });
        assert!(Parameters::check(&Slot::None).is_ok());
        let error = "slot.move = 10; it must be in 1 to 9".to_owned();
        assert_eq!(
            message(Sample {
                slot,
                ..Sample::default()
            }),
            Err(error)
        );
    }

    #[test]
    fn the_schema_has_range_unit_default_and_words() {
        let schema = schemars::schema_for!(Sample).to_value();
        let low = &schema["properties"]["low"];
        assert_eq!(low["minimum"], 0.0);
        assert_eq!(low["maximum"], 1.0);
        assert_eq!(low["default"], 0.25);
        assert_eq!(low["description"], "The least share.");
        let rules = schema["$defs"]["Slot"]["oneOf"].as_array().unwrap();
        let counts = |rule: &&serde_json::Value| rule["properties"].get("move").is_some();
        let count = &rules.iter().find(counts).unwrap()["properties"]["move"];
        assert_eq!(
            (&count["minimum"], &count["maximum"]),
            (&1.into(), &9.into())
        );
    }
}
