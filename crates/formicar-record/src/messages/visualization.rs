//! `visualization_msgs`.

use super::common::{ColorRGBA, Duration, Header};
use super::field::messages;
use super::geometry::{Point, Pose, Vector3};
use super::sensor::CompressedImage;

messages! { "visualization_msgs":
    /// A point of a texture, 0 to 1.
    UVCoordinate {
        /// Across.
        u: f32,
        /// Up.
        v: f32,
    }

    /// A file of a mesh.
    MeshFile {
        /// Its name.
        filename: String,
        /// Its bytes.
        data: Vec<u8>,
    }

    /// A shape to draw.
    Marker {
        /// Time and frame.
        header: Header,
        /// Markers of a name space are shown and hidden together.
        ns: String,
        /// Number in the name space.
        id: i32,
        /// Shape: one of the constants of this type.
        r#type: i32,
        /// 0 adds or changes, 2 deletes.
        action: i32,
        /// Pose of the shape.
        pose: Pose,
        /// Size, meters; of lines, x is the width.
        scale: Vector3,
        /// Color.
        color: ColorRGBA,
        /// Time for which it is shown; 0 is forever.
        lifetime: Duration,
        /// Moves with its frame.
        frame_locked: bool,
        /// Points of lines, meters in the pose.
        points: Vec<Point>,
        /// Colors of the points, or nothing.
        colors: Vec<ColorRGBA>,
        /// Name of a texture.
        texture_resource: String,
        /// The texture.
        texture: CompressedImage,
        /// Places in the texture.
        uv_coordinates: Vec<UVCoordinate>,
        /// Words to show.
        text: String,
        /// Name of a mesh.
        mesh_resource: String,
        /// The mesh.
        mesh_file: MeshFile,
        /// Uses the materials in the mesh.
        mesh_use_embedded_materials: bool,
    }

    /// Shapes to draw.
    MarkerArray {
        /// The shapes.
        markers: Vec<Marker>,
    }
}

impl Marker {
    /// A line through all points.
    pub const LINE_STRIP: i32 = 4;
}
