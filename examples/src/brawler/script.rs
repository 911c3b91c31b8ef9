//! Somebody who plays.

use twohalf::Vector3;

use super::game::*;

/// Somebody who knows the street, and presses the keys.
pub fn script(game: &Brawler) -> Keys {
    let me = game.player();
    let is_at_edge =
        (HOLE[0] - 14.0..HOLE[0] + 20.0).contains(&me.x) || (POND[0] - 12.0..POND[0]).contains(&me.x);
    let near = |at: Vector3| (at.y - me.y).abs() < 40.0;
    let ahead = game.fighters[1..].iter().map(|thug| (thug.health, thug.actor.place(&game.simulator)));
    let ahead = ahead.filter(|(health, at)| *health > 0 && near(*at) && (at - me).norm() < 240.0);
    let thug = ahead.map(|(_, at)| at).min_by(|a, b| (a - me).norm().total_cmp(&(b - me).norm()));
    let wrecker = game.loads[0].thing.place(&game.simulator) - me;
    let is_in_the_way = (0.0..44.0).contains(&wrecker.x) && wrecker.z.abs() < 24.0;
    if let Some(at) = thug {
        let (way, z) = (at - me, (at.z - me.z).clamp(-20.0, 20.0) / 20.0);
        let (throws, is_close) =
            (game.state.hands.held().is_some() && way.z.abs() < 14.0, way.x.abs() < 52.0);
        let x = if is_close { 0.01 * way.x.signum() } else { way.x.signum() };
        let punch = is_close && way.z.abs() < 14.0 || is_in_the_way;
        return Keys { x, z, grab: throws, punch, jump: is_at_edge && x > 0.0 };
    }
    let in_reach = |load: &Load| {
        let way = load.thing.place(&game.simulator) - me;
        (0.0..42.0).contains(&way.x) && way.z.abs() < 20.0 && near(load.thing.place(&game.simulator))
    };
    if game.state.hands.held().is_none() && me.x < 1000.0 && game.loads[1..].iter().any(in_reach) {
        return Keys { grab: true, ..Keys::default() };
    }
    let pressed = game.height_of(game.press) < TERRACE + 88.0;
    let waits = (LIFT[0] - 40.0..LIFT[0] - 13.0).contains(&me.x)
        && game.height_of(game.lift) + TERRACE > 12.0
        || (LIFT[0] + 20.0..LIFT[1]).contains(&me.x) && me.y < TERRACE - 6.0
        || (PRESS[0] - 40.0..PRESS[0] - 14.0).contains(&me.x) && pressed;
    Keys { x: f32::from(u8::from(!waits)), z: (80.0 - me.z) / 40.0, jump: is_at_edge, ..Keys::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_script_plays_to_the_end_of_the_street() {
        let mut game = Brawler::new().unwrap();
        for _ in 0..60 * RATE {
            game.step(script(&game)).unwrap();
        }
        assert!(game.fighters.len() == 1 && game.player().x > 1900.0, "{}", game.player());
    }
}
