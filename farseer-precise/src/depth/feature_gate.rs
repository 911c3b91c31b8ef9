//! Proof that the crate has a depth axis. Without the feature `space` the compiler removes all code for depth.

/// Whether the crate has a depth axis: the cargo feature `space`.
pub const IS_DEPTH_ENABLED: bool = cfg!(feature = "space");

/// Proof that the feature `space` is on. Without the feature the type has no value, so that the compiler removes all code for
/// depth.
#[cfg(feature = "space")]
type FeatureProof = ();
#[cfg(not(feature = "space"))]
type FeatureProof = std::convert::Infallible;

/// Holds the state of the depth axis, owned or borrowed, that exists only if the feature `space` is on.
#[derive(Debug, Clone, Copy)]
pub struct FeatureGate<S> {
    state: S,
    proof: FeatureProof,
}

impl<S: Default> FeatureGate<Box<S>> {
    /// Returns an empty state; `None` without the feature `space`.
    pub fn new() -> Option<Self> {
        #[cfg(feature = "space")]
        return Some(FeatureGate { state: Box::default(), proof: () });
        #[cfg(not(feature = "space"))]
        None
    }

    /// Returns the depth state as a reference, with its proof of the feature `space`.
    pub fn by_ref(&self) -> FeatureGate<&S> {
        FeatureGate { state: &self.state, proof: self.proof }
    }

    /// Returns the depth state as a mutable reference, with its proof of the feature `space`.
    pub fn by_mut(&mut self) -> FeatureGate<&mut S> {
        FeatureGate { state: &mut self.state, proof: self.proof }
    }
}

impl<S: std::ops::Deref> std::ops::Deref for FeatureGate<S> {
    type Target = S::Target;

    #[inline(always)]
    fn deref(&self) -> &S::Target {
        &self.state
    }
}

impl<S: std::ops::DerefMut> std::ops::DerefMut for FeatureGate<S> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut S::Target {
        &mut self.state
    }
}
