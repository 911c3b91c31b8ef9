//! A script that plays the game.

use twohalf_factories::Spawned;

use super::game::*;

/// The keys of a player who knows the street.
pub fn script(game: &Brawler) -> Keys {
    let (me, holds) = (game.player(), game.state.hands.held().is_some());
    let jump = (HOLE[0] - 14.0..HOLE[0] + 20.0).contains(&me.x) || (POND[0] - 12.0..POND[0]).contains(&me.x);
    let in_reach = |load: &Spawned| {
        let way = load.place(&game.simulator) - me;
        (0.0..44.0).contains(&way.x) && way.y.abs() < 40.0 && way.z.abs() < 20.0
    };
    let thugs = game.fighters[1..].iter().filter(|thug| thug.health > 0);
    let ways = thugs.map(|thug| thug.actor.place(&game.simulator) - me);
    let near = ways.filter(|way| way.y.abs() < 40.0 && way.norm() < 240.0);
    if let Some(way) = near.min_by(|a, b| a.norm().total_cmp(&b.norm())) {
        let (is_close, is_level) = (way.x.abs() < 52.0, way.z.abs() < 14.0);
        let x = if is_close { 0.01 } else { 1.0 } * way.x.signum();
        let punch = is_close && is_level || game.loads.iter().any(in_reach);
        let (z, grab) = ((way.z / 20.0).clamp(-1.0, 1.0), holds && is_level);
        return Keys { x, z, grab, punch, jump: jump && x > 0.5 };
    }
    let grab = !holds && me.x < 1000.0 && game.loads[1..].iter().any(in_reach);
    let waits = (LIFT[0] - 40.0..LIFT[0] - 13.0).contains(&me.x)
        && game.height_of(game.lift) + TERRACE > 12.0
        || (LIFT[0] + 20.0..LIFT[1]).contains(&me.x) && me.y < TERRACE - 6.0
        || (PRESS[0] - 40.0..PRESS[0] - 14.0).contains(&me.x) && game.height_of(game.press) < TERRACE + 88.0;
    let x = if waits || grab { 0.0 } else { 1.0 };
    Keys { x, z: (80.0 - me.z) / 40.0, jump, grab, ..Keys::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_script_plays_to_the_end_of_the_street() {
        let mut game = Brawler::new().unwrap();
        (0..60 * RATE).for_each(|_| game.step(script(&game)).unwrap());
        assert!(game.fighters.len() == 1 && game.player().x > 1900.0, "{}", game.player());
    }
}
