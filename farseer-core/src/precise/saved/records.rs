//! The parts of [`Saved`](super::Saved) of which there are many, as records of words.

use super::{ImportedState, SavedManifold, SavedProxy, SavedSleeperIndex, SavedSleepingBody};
use crate::body::BodyId;
use crate::geom::GeomId;
use farseer_precise::broad_phase::pairs::CachedManifoldZ;
use farseer_precise::broad_phase::proxies::BodyType;
use farseer_precise::depth::interface::DepthInterval;
use farseer_precise::saved_record;
use farseer_precise::storage::words::{Record, Words};
use farseer_precise::surface::{CombinationRule, SurfaceOptions};

saved_record!(SavedManifold);
saved_record!(SavedProxy);
saved_record!(SavedSleepingBody);

impl Record for SavedManifold {
    const WORDS: usize = 29;

    #[inline(always)]
    fn visit(&mut self, words: &mut impl Words) {
        words.floats(&mut self.rotations);
        words.floats(&mut self.relative_pose);
        words.floats(&mut self.normal);
        words.word(&mut self.count);
        self.anchors.iter_mut().for_each(|anchor| words.floats(anchor));
        words.floats(&mut self.separations);
        self.features.iter_mut().for_each(|feature| words.word(feature));
        words.float(&mut self.arm_lead_angle);
        let CachedManifoldZ { normal_z, z_offset, patch_radius, points_z } = &mut self.depth;
        [normal_z, z_offset, patch_radius].into_iter().for_each(|number| words.float(number));
        words.floats(points_z);
    }
}

impl Default for SavedProxy {
    fn default() -> Self {
        SavedProxy {
            geom: GeomId::from_bits(0),
            number: 0,
            piece: 0,
            body_type: BodyType::Fixed,
            fat_aabb: [0.0; 4],
            depth_interval: DepthInterval::default(),
            travel: 0,
            is_refitted: false,
            imported: ImportedState::default(),
        }
    }
}

impl Record for SavedProxy {
    const WORDS: usize = 40;

    #[inline(always)]
    fn visit(&mut self, words: &mut impl Words) {
        let mut geom = self.geom.to_bits();
        words.long(&mut geom);
        self.geom = GeomId::from_bits(geom);
        words.word(&mut self.number);
        words.word(&mut self.piece);
        let mut body_type = self.body_type as u32;
        words.word(&mut body_type);
        let types = [BodyType::Fixed, BodyType::Kinematic, BodyType::Hinged, BodyType::Dynamic];
        // Of damaged data any type is a possible one.
        self.body_type =
            types.into_iter().find(|&known| known as u32 == body_type).unwrap_or(BodyType::Fixed);
        words.floats(&mut self.fat_aabb);
        words.float(&mut self.depth_interval.low);
        words.float(&mut self.depth_interval.high);
        words.word(&mut self.travel);
        words.flags([&mut self.is_refitted]);
        words.floats(&mut self.imported.pose);
        words.floats(&mut self.imported.contact_properties);
        visit_surface(&mut self.imported.surface, words);
        for number in &mut self.imported.filter {
            let mut word = number.cast_unsigned();
            words.word(&mut word);
            *number = word.cast_signed();
        }
        words.maybe(&mut self.imported.one_way);
        words.long(&mut self.imported.fingerprint);
    }
}

/// Visits the four words of a surface.
#[inline(always)]
fn visit_surface(surface: &mut SurfaceOptions, words: &mut impl Words) {
    let SurfaceOptions { friction_rule, restitution_rule, speed, rolling_resistance } = surface;
    for rule in [friction_rule, restitution_rule] {
        let rules = [
            None,
            Some(CombinationRule::Mean),
            Some(CombinationRule::GeometricMean),
            Some(CombinationRule::Minimum),
            Some(CombinationRule::Product),
            Some(CombinationRule::Maximum),
        ];
        let mut word = rules.iter().position(|known| known == rule).unwrap_or(0) as u32;
        words.word(&mut word);
        // Of damaged data any rule is a possible one.
        *rule = rules.get(word as usize).copied().flatten();
    }
    words.float(speed);
    words.float(rolling_resistance);
}

impl Default for SavedSleepingBody {
    fn default() -> Self {
        SavedSleepingBody {
            body: BodyId::from_bits(0),
            first: SavedSleeperIndex::default(),
            pose: [0.0; 4],
            supported_acceleration: [0.0; 4],
            constants: [0.0; 4],
            is_newly_asleep: false,
        }
    }
}

impl Record for SavedSleepingBody {
    const WORDS: usize = 16;

    #[inline(always)]
    fn visit(&mut self, words: &mut impl Words) {
        let mut body = self.body.to_bits();
        words.long(&mut body);
        self.body = BodyId::from_bits(body);
        words.word(&mut self.first.0);
        words.floats(&mut self.pose);
        words.floats(&mut self.supported_acceleration);
        words.floats(&mut self.constants);
        words.flags([&mut self.is_newly_asleep]);
    }
}
