//! Which body is drawn over which.

use farseer_core::BodyId;

use crate::TwoHalfPhysicsSimulator;

impl TwoHalfPhysicsSimulator {
    /// The bodies that take part, back to front: draw them in this order. The nearer one (smaller Z) comes later;
    /// of those at the same Z, the higher one; of those at the same height as well, the one added later.
    pub fn draw_order(&self) -> Vec<BodyId> {
        let mut keyed: Vec<(f32, f32, BodyId)> = self
            .body_list()
            .iter()
            .filter_map(|&id| {
                let position = self.body(id)?.position3d();
                // Adding zero makes both zeros one value.
                Some((-position.z + 0.0, position.y + 0.0, id))
            })
            .collect();
        keyed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        keyed.into_iter().map(|(_, _, id)| id).collect()
    }
}
