//! Continuous collision of bodies that joints tie together: all of them stop at the first time of impact of one.
//!
//! Were the way of that one alone cut off, its joints would gape by what the others move in the rest of the step: 0.3 m after a fall of
//! 40 m. Closing them would throw the figure up.

use super::Precise;
use super::continuous::Flight;
use crate::storage::order::sort_by_number;

impl Precise {
    /// Flights of joined bodies end together. Flights are in the order of their bodies, before and after.
    pub(super) fn stop_joined(&self, flights: &mut Vec<Flight>) {
        if self.space.is_some() || self.joints.are_none() || flights.iter().all(|flight| flight.time >= 1.0) {
            return;
        }
        let in_flight = flights.len();
        for bodies in self.joints.articulations().filter(|bodies| bodies.len() > 1) {
            let place =
                |body: &u32| flights[..in_flight].binary_search_by_key(body, |flight| flight.body).ok();
            let first = bodies.iter().filter_map(place).map(|at| flights[at]).reduce(|first, flight| {
                let key = |flight: &Flight| (flight.time, flight.body);
                if key(&flight) < key(&first) { flight } else { first }
            });
            let Some(Flight { time, pair, stopped, .. }) = first.filter(|first| first.time < 1.0) else {
                continue;
            };
            for &body in bodies {
                let joined = Flight { time, pair, stopped, is_joined: true, ..Flight::of(body) };
                match flights[..in_flight].binary_search_by_key(&body, |flight| flight.body) {
                    Ok(at) => flights[at] = joined,
                    Err(_) => flights.push(joined),
                }
            }
        }
        sort_by_number(flights, |flight| flight.body.into());
    }

    /// The velocity of a joined body at this part of the step. The mean of two velocities that joints allow is one that they allow; less
    /// the rest of what forces do, a body that hangs would not be at rest.
    pub(super) fn slow_joined(&mut self, body: usize, time: f32) {
        let before = self.bodies.before[body];
        for (velocity, before) in self.bodies.hot[body].velocity.iter_mut().zip(before) {
            *velocity = before + (*velocity - before) * time;
        }
    }
}
