//! Requests, answers and paths as documents: what front ends read and write.

#[cfg(feature = "serde")]
mod answer;
mod explanation;
#[cfg(feature = "serde")]
mod motion_record;
#[cfg(feature = "serde")]
mod path_document;
#[cfg(feature = "serde")]
mod recorded_poses;
#[cfg(feature = "serde")]
mod request_document;
#[cfg(feature = "serde")]
mod stored_path;
#[cfg(feature = "serde")]
mod via_record;

#[cfg(feature = "serde")]
pub use answer::{
    ANSWER_SCHEMA, Answer, AnswerContext, AnswerStatus, ColonyRecord, ConfigRecord, EscapeRecord,
    KeepOutMapRecord, MapRecord, Provenance, SoftCostsRecord, Timing, VehicleRecord,
};
pub use explanation::{Collision, Disconnected, Explanation, Gap};
#[cfg(feature = "serde")]
pub use motion_record::{MOVING_SCHEMA, MotionRecord, MovingDocument, ProfileRecord};
#[cfg(feature = "serde")]
pub use path_document::{PathDocument, PoseRecord, SegmentRecord};
#[cfg(feature = "serde")]
pub use recorded_poses::are_samples_of;
#[cfg(feature = "serde")]
pub use request_document::RequestDocument;
#[cfg(feature = "serde")]
pub use stored_path::{AnswerError, CertificateHashes, CertificateNumbers, StoredPath};
#[cfg(feature = "serde")]
pub use via_record::ViaRecord;
