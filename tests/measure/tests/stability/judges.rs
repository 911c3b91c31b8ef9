//! The judges of the stability map fail a world that is wrong, and hold one that is right: they are shown bodies that are
//! where a test says, and not where an engine moves them.

use crate::common::told::{Told, flat};
use measure::method::methods;
use measure::stability::{StabilityFamily, families, reasons};
use measure::world::BodyState;

/// A metre in px.
const METRE: f64 = 32.0;

fn family(name: &str) -> StabilityFamily {
    let found = families().into_iter().find(|family| family.name == name);
    found.unwrap_or_else(|| panic!("there is no family {name}"))
}

/// The families whose names begin so.
fn all_of(names: &[&str]) -> Vec<StabilityFamily> {
    let found =
        families().into_iter().filter(|family| names.iter().any(|name| family.name.starts_with(name)));
    let found: Vec<_> = found.collect();
    assert!(!found.is_empty());
    found
}

/// The families of what must stay where it began.
fn standing() -> Vec<StabilityFamily> {
    families().into_iter().filter(|family| family.quantity.starts_with("greatest displacement")).collect()
}

/// Shows the judge of a family the bodies as they begin, changed by a law of the time as a share of the run. Gives what
/// was measured, and what failed.
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
        watch.see(share * (family.seconds)(value), &Told(states));
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

/// Puts the boxes of the pyramid that begins with overlaps side by side and on each other.
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

/// The uppermost box of that pyramid.
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
fn a_pyramid_that_comes_apart_has_recovered() {
    assert_eq!(recovered(|_| {}), (0.0, None));
}

#[test]
fn an_overlap_of_a_tenth_of_a_box_is_the_most_that_may_be_left() {
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
    // A metre above the top of the pyramid that came apart, whose middle is 3.5 m high.
    let at = |height: f64| recovered(move |states| states[TOP].position[1] = -height * METRE).1;
    assert_eq!([at(4.4), at(4.6)], [None, Some(reasons::BLEW_UP)]);
}

#[test]
fn overlap_recovery_measures_the_greatest_speed() {
    let (speed, _) = recovered(|states| states[TOP].velocity = flat([30.0, -40.0]));
    assert_eq!(speed, 50.0);
}

#[test]
fn what_never_moves_at_a_wall_is_stuck() {
    for family in all_of(&["Bullet", "Fast Bodies", "Spinning Plank"]) {
        let found = verdict(&family, family.values[0], |_, _| {});
        assert_eq!(found, Some(reasons::STUCK), "{}", family.name);
    }
}

/// Where the middle of what flies at a wall is when it has arrived, in px before the wall's face: it touches.
fn touching(family: &StabilityFamily) -> f64 {
    if family.name.starts_with("Bullet") { 4.0 } else { 16.0 }
}

#[test]
fn what_arrives_at_a_wall_and_is_thrown_back_holds_whenever_that_is() {
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
fn what_flies_at_a_wall_fails_when_one_of_all_stops_short() {
    for family in all_of(&["Bullet", "Fast Bodies"]) {
        let found = verdict(&family, family.values[0], |_, states| {
            for state in &mut states[1..] {
                state.position[0] = -touching(&family);
            }
            // A body's size and a little more is left.
            states[5].position[0] = -2.1 * touching(&family);
        });
        assert_eq!(found, Some(reasons::STUCK), "{}", family.name);
    }
}

#[test]
fn what_arrives_behind_a_wall_has_tunnelled() {
    for family in all_of(&["Bullet", "Fast Bodies"]) {
        let found = verdict(&family, family.values[0], |_, states| {
            states[1..].iter_mut().for_each(|state| state.position[0] = 1000.0);
        });
        assert_eq!(found, Some(reasons::TUNNELLED), "{}", family.name);
    }
}

#[test]
fn a_plank_that_comes_to_lie_on_the_floor_holds_and_one_below_it_has_tunnelled() {
    let family = family("Spinning Plank");
    let at = |height: f64| verdict(&family, 0.0, move |_, states| states[1].position[1] = -height);
    assert_eq!([at(1.0), at(-20.0)], [None, Some(reasons::TUNNELLED)]);
}

/// The families of joints, with a gap in px that is too wide.
fn jointed() -> Vec<(StabilityFamily, f64, &'static str)> {
    let names = ["Bridge", "Ball and Chain", "Stretched Chain", "Joint Grid", "Far Chain", "Ragdoll"];
    let stretched = names.map(|name| (family(name), 3.3, reasons::STRETCHED));
    [&stretched[..], &[(family("Breakable Joint"), 33.0, reasons::BROKE)]].concat()
}

/// Opens the joints of the last body while the share of the run is in a range, which must not begin with the run: joints
/// are taken to be closed then.
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
fn a_joint_that_is_open_before_the_last_fifth_alone_holds() {
    for (family, gap, _) in jointed() {
        assert_eq!(opened(&family, gap, 0.1..0.8).1, None, "{}", family.name);
    }
}

#[test]
fn a_gap_that_a_joint_may_have_holds() {
    for (family, gap, _) in jointed() {
        assert_eq!(opened(&family, 0.9 * gap, 0.1..2.0).1, None, "{}", family.name);
    }
}

#[test]
fn what_stays_where_it_began_stands() {
    for family in standing() {
        assert_eq!(judged(&family, family.values[0], |_, _| {}), (0.0, None), "{}", family.name);
    }
}

/// What comes of a standing scene in which a body ends higher by so many px.
fn risen(family: &StabilityFamily, value: f64, body: usize, by: f64) -> Option<&'static str> {
    verdict(family, value, |share, states| {
        // Long enough before the last fifth that it does not creep.
        if share > 0.5 {
            states[body].position[1] -= by;
        }
    })
}

#[test]
fn nothing_that_stands_ends_half_a_metre_lower_or_higher() {
    for family in standing() {
        let at = |by: f64| risen(&family, family.values[0], 1, by);
        let expected = [Some(reasons::SANK), Some(reasons::BLEW_UP)];
        assert_eq!([at(-16.5), at(16.5)], expected, "{}", family.name);
    }
}

#[test]
fn the_top_of_a_high_stack_may_end_half_a_box_off_and_no_more() {
    // It is 624 px high, of which a tenth is four times as much.
    let at = |by: f64| risen(&family("Vertical Stack"), 20.0, 20, by);
    assert_eq!([at(-15.5), at(15.5)], [None, None]);
    assert_eq!([at(-16.5), at(16.5)], [Some(reasons::SANK), Some(reasons::BLEW_UP)]);
}

#[test]
fn the_foot_of_a_stack_may_end_a_tenth_of_its_height_off_and_no_more() {
    // Its middle is 16 px high.
    let at = |by: f64| risen(&family("Vertical Stack"), 20.0, 1, by);
    assert_eq!([at(-1.5), at(1.5)], [None, None]);
    assert_eq!([at(-1.7), at(1.7)], [Some(reasons::SANK), Some(reasons::BLEW_UP)]);
}

#[test]
fn boxes_that_are_not_on_the_second_floor_at_the_end_were_not_put_there() {
    let family = family("Teleport");
    let at = |distance: f64| {
        verdict(&family, 1000.0, move |_, states| {
            states[2..].iter_mut().for_each(|state| state.position[0] += distance);
        })
    };
    assert_eq!([at(0.0), at(980.0), at(1000.0)], [Some(reasons::TOPPLED), Some(reasons::TOPPLED), None]);
}
