//! Masses and moments of inertia from their reciprocals.

/// Mass or moment of inertia that stands for an infinite one. Unit: mass units; for a moment of inertia mass units * length
/// units^2.
///
/// The value is so large that no impulse changes a velocity in `f64`. Value chosen; its sensitivity is not measured.
pub(crate) const INFINITE_MASS: f64 = 1e60;

/// Returns a mass (mass units) or moment of inertia (mass units * length units^2) from its reciprocal; [`INFINITE_MASS`] for 0.
pub(crate) fn mass_of_inverse(inverse: f32) -> f64 {
    if inverse > 0.0 { 1.0 / f64::from(inverse) } else { INFINITE_MASS }
}

/// Returns the radius of gyration of a body, in length units; 0 for a body that cannot rotate: errors of its joints are small or
/// large beside its arms. `mass` in mass units, `inertia` in mass units * length units^2.
pub(crate) fn radius_of_gyration(mass: f64, inertia: f64) -> f64 {
    if inertia < INFINITE_MASS { (inertia / mass).sqrt() } else { 0.0 }
}
