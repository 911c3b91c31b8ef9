//! Types of the indices of joints and springs.

use crate::index::index_type;

index_type! {
    /// Index of an active joint, in the order of the simulator's list of joints.
    pub struct JointIndex;
}
index_type! {
    /// Index of a spring that is a row in this step.
    pub struct SpringIndex;
}

/// Index of a joint or of a spring.
#[derive(Debug, Clone, Copy)]
pub(crate) enum CandidateIndex {
    /// Index of a joint.
    Joint(JointIndex),
    /// Index of a spring.
    Spring(SpringIndex),
}
