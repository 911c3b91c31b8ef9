//! Tests that the judges of the stability map fail a world in a wrong state and accept one in a right state. The judges see
//! prescribed positions of bodies; no engine runs.

use crate::common::told::{PrescribedWorld, flat};
use measure::method::methods;
use measure::stability::{StabilityFamily, families, reasons};
use measure::world::BodyState;

/// Length of a metre, px.
const METRE: f64 = 32.0;

fn family(name: &str) -> StabilityFamily {
    let found = families().into_iter().find(|family| family.name == name);
    found.unwrap_or_else(|| panic!("there is no family {name}"))
}

/// Returns the families whose names begin with one of `names`.
fn all_of(names: &[&str]) -> Vec<StabilityFamily> {
    let found =
        families().into_iter().filter(|family| names.iter().any(|name| family.name.starts_with(name)));
    let found: Vec<_> = found.collect();
    assert!(!found.is_empty());
    found
}

/// Returns the families in which bodies must stay at their initial positions.
fn standing() -> Vec<StabilityFamily> {
    families().into_iter().filter(|family| family.quantity.starts_with("greatest displacement")).collect()
}

/// Runs the judge of a family on bodies in their initial states, altered by `law`. The first argument of `law` is the time as a
/// fraction of the run, 0..=1. Returns the measured value, in the unit of the family, and the failure.
fn judged(
    family: &StabilityFamily,
    value: f64,
    law: impl Fn(f64, &mut [BodyState]),
) -> (f64, Option<&'static str>) {
    let method = methods()[0];
    let scene = (family.build)(value, method.recommended.dt.mean());
    let world = (method.build)(&scene, method.recommended).expect("the scene can be built");
    let starts: Vec<BodyState> = (0..world.body_count()).map(|index| world.body(index)).collect();
    let mut watch = (family.judge)(value, &scene);
    for step in 0..=100 {
        let share = f64::from(step) / 100.0;
        let mut states = starts.clone();
        law(share, &mut states);
        watch.observe(share * (family.seconds)(value), &PrescribedWorld(states));
    }
    (watch.error(), watch.failed())
}

fn verdict(
    family: &StabilityFamily,
    value: f64,
    law: impl Fn(f64, &mut [BodyState]),
) -> Option<&'static str> {
    judged(family, value, law).1
}

#[test]
fn a_state_that_is_not_finite_fails_in_every_family() {
    for family in families() {
        let found = verdict(&family, family.values[0], |_, states| {
            for state in states {
                state.velocity[0] = f64::NAN;
            }
        });
        assert_eq!(found, Some(reasons::NOT_FINITE), "{}", family.name);
    }
}

/// Sets the positions of the pyramid's boxes so that they touch without overlaps. The pyramid is that of `Overlap Recovery`.
fn come_apart(states: &mut [BodyState]) {
    let mut body = 1;
    for row in 0..4 {
        for column in 0..4 - row {
            let from_centre = f64::from(column) - f64::from(3 - row) / 2.0;
            states[body].position = flat([METRE * from_centre, -METRE * (f64::from(row) + 0.5)]);
            body += 1;
        }
    }
    assert_eq!(body, states.len());
}

/// Index of the uppermost box of the pyramid in the family `Overlap Recovery`.
const TOP: usize = 10;

fn recovered(change: impl Fn(&mut [BodyState])) -> (f64, Option<&'static str>) {
    judged(&family("Overlap Recovery"), 0.2, |_, states| {
        come_apart(states);
        change(states);
    })
}

#[test]
fn a_pyramid_that_stays_in_its_overlaps_has_not_recovered() {
    assert_eq!(verdict(&family("Overlap Recovery"), 0.2, |_, _| {}), Some(reasons::SANK));
}

#[test]
fn a_pyramid_that_separates_has_recovered() {
    assert_eq!(recovered(|_| {}), (0.0, None));
}

#[test]
fn the_greatest_remaining_overlap_is_a_tenth_of_a_box() {
    let lower = |by: f64| recovered(move |states| states[TOP].position[1] += by).1;
    assert_eq!([lower(3.1), lower(3.3)], [None, Some(reasons::SANK)]);
}

#[test]
fn a_pyramid_of_which_a_box_is_below_the_floor_has_not_recovered() {
    let below = recovered(|states| states[TOP].position = flat([0.0, 5.0 * METRE]));
    assert_eq!(below.1, Some(reasons::TUNNELLED));
}

#[test]
fn a_pyramid_that_throws_a_box_has_blown_up() {
    // The limit is a metre above the top of the separated pyramid. The middle of its uppermost box is at 3.5 m.
    let at = |height: f64| recovered(move |states| states[TOP].position[1] = -height * METRE).1;
    assert_eq!([at(4.4), at(4.6)], [None, Some(reasons::BLEW_UP)]);
}

#[test]
fn overlap_recovery_measures_the_greatest_speed() {
    let (speed, _) = recovered(|states| states[TOP].velocity = flat([30.0, -40.0]));
    assert_eq!(speed, 50.0);
}

#[test]
fn a_body_that_never_moves_towards_its_wall_is_stuck() {
    for family in all_of(&["Bullet", "Fast Bodies", "Spinning Plank"]) {
        let found = verdict(&family, family.values[0], |_, _| {});
        assert_eq!(found, Some(reasons::STUCK), "{}", family.name);
    }
}

/// Returns the distance, in px, from the face of the wall to the middle of a body that touches the wall.
fn touching(family: &StabilityFamily) -> f64 {
    if family.name.starts_with("Bullet") { 4.0 } else { 16.0 }
}

#[test]
fn a_body_that_bounces_off_its_wall_at_any_time_passes() {
    for family in all_of(&["Bullet", "Fast Bodies"]) {
        let found = verdict(&family, family.values[0], |share, states| {
            for (index, state) in states[1..].iter_mut().enumerate() {
                if (100.0 * share).round() == 10.0 * index as f64 {
                    state.position[0] = -touching(&family);
                }
            }
        });
        assert_eq!(found, None, "{}", family.name);
    }
}

#[test]
fn flight_at_a_wall_fails_if_one_body_stops_short() {
    for family in all_of(&["Bullet", "Fast Bodies"]) {
        let found = verdict(&family, family.values[0], |_, states| {
            for state in &mut states[1..] {
                state.position[0] = -touching(&family);
            }
            // The body stops at a distance from the wall that is a little greater than its size.
            states[5].position[0] = -2.1 * touching(&family);
        });
        assert_eq!(found, Some(reasons::STUCK), "{}", family.name);
    }
}

#[test]
fn a_body_behind_its_wall_has_tunnelled() {
    for family in all_of(&["Bullet", "Fast Bodies"]) {
        let found = verdict(&family, family.values[0], |_, states| {
            states[1..].iter_mut().for_each(|state| state.position[0] = 1000.0);
        });
        assert_eq!(found, Some(reasons::TUNNELLED), "{}", family.name);
    }
}

#[test]
fn a_plank_on_the_floor_passes_and_one_below_it_has_tunnelled() {
    let family = family("Spinning Plank");
    let at = |height: f64| verdict(&family, 0.0, move |_, states| states[1].position[1] = -height);
    assert_eq!([at(1.0), at(-20.0)], [None, Some(reasons::TUNNELLED)]);
}

/// Returns each family with joints, a gap in px that is too wide for it, and the expected reason of failure.
fn jointed() -> Vec<(StabilityFamily, f64, &'static str)> {
    let names = ["Bridge", "Ball and Chain", "Stretched Chain", "Joint Grid", "Far Chain", "Ragdoll"];
    let stretched = names.map(|name| (family(name), 3.3, reasons::STRETCHED));
    [&stretched[..], &[(family("Breakable Joint"), 33.0, reasons::BROKE)]].concat()
}

/// Opens the joints of the last body by `gap` px while the time is in `while_in`, as a fraction of the run. The judge takes
/// joints to be closed at the start, so the range must not include 0. Returns the measured gap in px and the failure.
fn opened(family: &StabilityFamily, gap: f64, while_in: std::ops::Range<f64>) -> (f64, Option<&'static str>) {
    judged(family, family.values[0], |share, states| {
        if while_in.contains(&share) {
            states.last_mut().expect("there are bodies").position[1] -= gap;
        }
    })
}

#[test]
fn a_joint_that_is_open_in_the_last_fifth_fails_though_it_is_closed_at_the_end() {
    for (family, gap, reason) in jointed() {
        let (measured, failed) = opened(&family, gap, 0.85..0.95);
        assert_eq!(failed, Some(reason), "{}", family.name);
        approx::assert_relative_eq!(measured, gap, max_relative = 1e-9);
    }
}

#[test]
fn a_joint_open_only_before_the_last_fifth_passes() {
    for (family, gap, _) in jointed() {
        assert_eq!(opened(&family, gap, 0.1..0.8).1, None, "{}", family.name);
    }
}

#[test]
fn a_gap_within_the_limit_passes() {
    for (family, gap, _) in jointed() {
        assert_eq!(opened(&family, 0.9 * gap, 0.1..2.0).1, None, "{}", family.name);
    }
}

#[test]
fn an_undisturbed_structure_stands() {
    for family in standing() {
        assert_eq!(judged(&family, family.values[0], |_, _| {}), (0.0, None), "{}", family.name);
    }
}

/// Returns the failure of a standing scene in whose second half a body is higher than at the start by the distance `by`, px.
fn risen(family: &StabilityFamily, value: f64, body: usize, by: f64) -> Option<&'static str> {
    verdict(family, value, |share, states| {
        // The body moves long before the last fifth of the run, so that the judge does not take the motion for creep.
        if share > 0.5 {
            states[body].position[1] -= by;
        }
    })
}

#[test]
fn a_standing_body_ends_within_half_a_metre_of_its_height() {
    for family in standing() {
        let at = |by: f64| risen(&family, family.values[0], 1, by);
        let expected = [Some(reasons::SANK), Some(reasons::BLEW_UP)];
        assert_eq!([at(-16.5), at(16.5)], expected, "{}", family.name);
    }
}

#[test]
fn the_top_of_a_high_stack_may_end_half_a_box_off_and_no_more() {
    // The top box is 624 px high. A tenth of that is four times as much as the limit of half a box.
    let at = |by: f64| risen(&family("Vertical Stack"), 20.0, 20, by);
    assert_eq!([at(-15.5), at(15.5)], [None, None]);
    assert_eq!([at(-16.5), at(16.5)], [Some(reasons::SANK), Some(reasons::BLEW_UP)]);
}

#[test]
fn the_foot_of_a_stack_may_end_a_tenth_of_its_height_off_and_no_more() {
    // The middle of the lowest box is 16 px high.
    let at = |by: f64| risen(&family("Vertical Stack"), 20.0, 1, by);
    assert_eq!([at(-1.5), at(1.5)], [None, None]);
    assert_eq!([at(-1.7), at(1.7)], [Some(reasons::SANK), Some(reasons::BLEW_UP)]);
}

#[test]
fn boxes_off_the_second_floor_at_the_end_fail() {
    let family = family("Teleport");
    let at = |distance: f64| {
        verdict(&family, 1000.0, move |_, states| {
            states[2..].iter_mut().for_each(|state| state.position[0] += distance);
        })
    };
    assert_eq!([at(0.0), at(980.0), at(1000.0)], [Some(reasons::TOPPLED), Some(reasons::TOPPLED), None]);
}
