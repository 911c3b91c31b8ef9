//! The methods (an engine with a scheme or with settings) that simulate 2.5D scenes.

use crate::engines::depth::TwoHalf;
#[cfg(feature = "peers")]
use crate::engines::rapier3d::Rapier;
use crate::method::{Built, Effort, Family, Mapped, Method, Setting, mapped};
use crate::scenes::depth::DepthScene;
use twohalf::DepthScheme;

/// A method (an engine with a scheme or with settings) that simulates 2.5D scenes.
pub type DepthMethod = Method<DepthScene>;

/// Returns all methods for 2.5D scenes, in the order in which charts and maps show them. New methods are added here.
pub fn depth_methods() -> Vec<DepthMethod> {
    #[allow(unused_mut)]
    let mut methods = our_methods();
    #[cfg(feature = "peers")]
    methods.extend(rapier_methods());
    methods
}

/// Returns names and versions of the engines of other projects that [`depth_methods`] compares with; empty without the
/// feature `peers`.
pub fn depth_peer_versions() -> Vec<(&'static str, String)> {
    #[cfg(feature = "peers")]
    return vec![("rapier3d", rapier3d::VERSION.to_owned())];
    #[cfg(not(feature = "peers"))]
    Vec::new()
}

fn our_methods() -> Vec<DepthMethod> {
    let faithful = DepthMethod {
        name: "2.5D, faithful",
        family: Family::Ours,
        is_broad_phase_variant: false,
        sleeps: false,
        // 5 iterations is the default of the 2D engine (behaviour chapter 06).
        recommended: Setting::fixed(1.0 / 60.0, 5),
        settings: our_settings,
        mapped: |effort| on_map(5, if effort == Effort::Full { &[20] } else { &[] }),
        build: |scene, setting| build(scene, setting, DepthScheme::Faithful),
    };
    let thesis = DepthMethod {
        name: "2.5D, thesis",
        build: |scene, setting| build(scene, setting, DepthScheme::Thesis),
        ..faithful
    };
    let precise = DepthMethod {
        name: "2.5D, precise",
        recommended: Setting::fixed(1.0 / 60.0, 4),
        settings: |effort| settings(effort, 4, 1, [2, 8, 16]),
        mapped: |_| on_map(4, &[]),
        build: |scene, setting| build(scene, setting, DepthScheme::Precise),
        ..faithful
    };
    vec![faithful, precise, thesis]
}

fn build(scene: &DepthScene, setting: Setting, scheme: DepthScheme) -> Built {
    Ok(Box::new(TwoHalf::with_scheme(scene, scheme, setting.passes as i32)))
}

/// Returns the two methods of `rapier3d`: one with the default settings of `rapier3d`, and one with settings that make it
/// more accurate. The accurate one has friction at every contact point and no contact recycling.
#[cfg(feature = "peers")]
fn rapier_methods() -> Vec<DepthMethod> {
    let default = DepthMethod {
        name: "rapier3d",
        family: Family::Peer,
        is_broad_phase_variant: false,
        sleeps: false,
        recommended: Setting::fixed(1.0 / 60.0, 4),
        settings: rapier_settings,
        mapped: |_| on_map(4, &[]),
        build: |scene, setting| Ok(Box::new(Rapier::new(scene).with_iterations(setting.passes as usize))),
    };
    let accurate = DepthMethod {
        name: "rapier3d, full friction",
        build: |scene, setting| {
            Ok(Box::new(Rapier::accurate(scene).with_iterations(setting.passes as usize)))
        },
        ..default
    };
    vec![default, accurate]
}

/// Returns the columns of a stability map. The `usual` number of iterations has a column at 1/30, 1/60 and 1/200 s; each
/// number in `others` has one at 1/60 and 1/200 s. The table of first failures shows `usual` at 1/60 and 1/200 s.
fn on_map(usual: u32, others: &[u32]) -> Vec<Mapped> {
    let [long, common, short] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 200.0];
    let first = [long, common, short].map(|dt| Setting::fixed(dt, usual));
    let more = others.iter().flat_map(|&passes| [common, short].map(|dt| Setting::fixed(dt, passes)));
    mapped(first.into_iter().chain(more), &first[1..])
}

/// Returns the settings of a chart's line for the faithful and the thesis scheme: steps that games take, each with the
/// default 5 iterations. The longest step (1/30 s) also has 2 iterations, and 1/60 s up to 40.
fn our_settings(effort: Effort) -> Vec<Setting> {
    settings(effort, 5, 2, [10, 20, 40])
}

/// Returns the settings of a chart's line for `rapier3d`, by default with 4 iterations. Each solver iteration of `rapier3d`
/// is a substep.
#[cfg(feature = "peers")]
fn rapier_settings(effort: Effort) -> Vec<Setting> {
    settings(effort, 4, 1, [2, 8, 16])
}

fn settings(effort: Effort, usual: u32, few: u32, [one, two, three]: [u32; 3]) -> Vec<Setting> {
    let quick = vec![
        Setting::fixed(1.0 / 30.0, few),
        Setting::fixed(1.0 / 30.0, usual),
        Setting::fixed(1.0 / 60.0, few),
        Setting::fixed(1.0 / 60.0, usual),
        Setting::fixed(1.0 / 60.0, two),
        Setting::fixed(1.0 / 240.0, usual),
        Setting::jitter(1.0 / 60.0, usual),
    ];
    if effort == Effort::Quick {
        return quick;
    }
    let full = [
        Setting::fixed(0.016, usual),
        Setting::fixed(0.01, usual),
        Setting::fixed(1.0 / 60.0, one),
        Setting::fixed(1.0 / 60.0, three),
        Setting::fixed(1.0 / 120.0, usual),
        Setting::fixed(1.0 / 240.0, two),
    ];
    quick.into_iter().chain(full).collect()
}
