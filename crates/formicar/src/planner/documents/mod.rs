//! Requests, answers and paths as documents: what front ends read and write.

mod answer;
mod explanation;
mod path_document;
mod request_document;
mod stored_path;
mod via_record;

pub use answer::{
    ANSWER_SCHEMA, Answer, AnswerContext, AnswerStatus, ColonyRecord, MapRecord, Provenance,
    SoftCostsRecord, Timing, VehicleRecord,
};
pub use explanation::{Collision, Disconnected, Explanation, Gap};
pub use path_document::{POSE_SPACING_M, PathDocument, PoseRecord, SegmentRecord};
pub use request_document::RequestDocument;
pub use stored_path::{AnswerError, CertificateHashes, CertificateNumbers, StoredPath};
pub use via_record::ViaRecord;
