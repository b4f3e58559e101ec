//! Types of fields, and definitions of messages as text.

use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Write;

/// A type that a field of a message may have.
pub trait Field {
    /// Its name in definitions of ROS, for instance `float32[]` or `std_msgs/Header`.
    fn type_name() -> String;

    /// Adds the definitions of the message types that it contains.
    fn define(_: &mut Definitions) {}
}

/// A message that can stand on a topic.
pub trait Message: Field + Serialize + DeserializeOwned {
    /// The name of its type, for instance `sensor_msgs/msg/LaserScan`.
    const TYPE: &'static str;
}

/// Definitions of message types, each once, in the order of their first use.
#[derive(Debug, Default)]
pub struct Definitions(Vec<(String, String)>);

impl Definitions {
    /// Adds a type with the types and names of its fields; false where it is there already.
    pub(super) fn add(&mut self, name: String, fields: &[(String, &str)]) -> bool {
        if self.0.iter().any(|(known, _)| *known == name) {
            return false;
        }
        let mut text = String::new();
        for (type_name, field) in fields {
            let _ = writeln!(text, "{type_name} {}", field.trim_start_matches("r#"));
        }
        self.0.push((name, text));
        true
    }
}

/// The definition of a message and of all types in it, joined as `ros2msg` schemas join them.
pub fn definition<M: Message>() -> String {
    let mut definitions = Definitions::default();
    M::define(&mut definitions);
    let mut text = String::new();
    for (i, (name, fields)) in definitions.0.iter().enumerate() {
        if i > 0 {
            let _ = writeln!(text, "{}\nMSG: {name}", "=".repeat(80));
        }
        text += fields;
    }
    text
}

/// Structs of messages, each with the package that defines it.
macro_rules! messages {
    ($package:literal: $(
        $(#[$about:meta])*
        $name:ident { $( $(#[$field_about:meta])* $field:ident: $type:ty, )* }
    )*) => {$(
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
        pub struct $name { $( $(#[$field_about])* pub $field: $type, )* }

        impl $crate::messages::Field for $name {
            fn type_name() -> String {
                concat!($package, "/", stringify!($name)).to_owned()
            }

            fn define(definitions: &mut $crate::messages::Definitions) {
                let fields = [$((
                    <$type as $crate::messages::Field>::type_name(),
                    stringify!($field),
                )),*];
                if definitions.add(Self::type_name(), &fields) {
                    $( <$type as $crate::messages::Field>::define(definitions); )*
                }
            }
        }

        impl $crate::messages::Message for $name {
            const TYPE: &'static str = concat!($package, "/msg/", stringify!($name));
        }
    )*};
}
pub(super) use messages;

macro_rules! primitives {
    ($($type:ty: $name:literal),*) => {$(
        impl Field for $type {
            fn type_name() -> String {
                $name.to_owned()
            }
        }
    )*};
}
primitives!(
    bool: "bool", u8: "uint8", i8: "int8", u32: "uint32", i32: "int32", f32: "float32",
    f64: "float64", String: "string", [[f64; 6]; 6]: "float64[36]"
);

impl<T: Field> Field for Vec<T> {
    fn type_name() -> String {
        format!("{}[]", T::type_name())
    }

    fn define(definitions: &mut Definitions) {
        T::define(definitions);
    }
}
