//! Checks random joint scenes of the precise set.

use crate::engine::Engine;
use crate::recording::StateHashes;
use crate::twins::restored;
use measure::joints::build::simulator;
use measure::joints::counts::outcome;
use measure::joints::engines::{OURS, SETTING};
use measure::joints::random::{UPDATES, Variant, scene, variants};

/// Number of updates between two restores.
const PERIOD: u32 = 45;

/// Checks the joint scenes of a seed, one of each variant. They do not blow up, do not gain energy, and continue after a
/// restore as they would without.
///
/// # Errors
/// Names the first of these properties that does not hold, and the variant.
pub fn figures_hold(seed: u64) -> Result<(), String> {
    variants().try_for_each(|variant| {
        let at = |what: String| format!("{}: {what}", variant.name());
        let outcome = outcome(seed, variant, &OURS).map_err(at)?;
        if outcome.is_wild() {
            return Err(at(format!("{:.0} px/s", outcome.speed)));
        }
        if outcome.is_gaining(variant) {
            return Err(at(format!("wins {:.0} px²/s² of energy per mass", outcome.gain)));
        }
        goes_on_as_restored(seed, variant).map_err(at)
    })
}

/// Checks that the joint scenes of a seed, one of each variant, continue after a restore as they would without.
///
/// # Errors
/// Names the first difference and the variant.
pub fn figures_go_on_as_restored(seed: u64) -> Result<(), String> {
    variants().try_for_each(|variant| {
        goes_on_as_restored(seed, variant).map_err(|what| format!("{}: {what}", variant.name()))
    })
}

fn goes_on_as_restored(seed: u64, variant: Variant) -> Result<(), String> {
    let assembly = scene(seed, variant);
    let dt = SETTING.dt.mean();
    let build = || simulator(&assembly, SETTING.passes as i32).map_err(|error| error.to_string());
    let ((mut plain, _), (mut twin, _)) = (build()?, build()?);
    for update in 1..=UPDATES {
        plain.update(dt);
        twin.update(dt);
        if update % PERIOD == 0 {
            plain.check_numbers()?;
            if StateHashes::of(&plain) != StateHashes::of(&twin) {
                return Err(format!("differs from its twin after {update} updates"));
            }
            twin = restored(&twin)?;
        }
    }
    Ok(())
}
