//! How far something upright is from other things, whether or not they take part: for queries of the engine above.

use super::foot::{Foot, Polygon};
use super::parts::SpaceUpright;
use super::solid::{Kind, Solid};
use super::standing;
use super::upright::Upright;
use super::upright_slant::roof_over;
use crate::geom::pieces::simplified;
use crate::math::Vector3;
use crate::precise::outline::Corners;
use crate::shape::SlantedBox;

/// Something with depth where it is, with y down.
#[derive(Debug, Clone, Copy)]
pub enum SpaceForm<'a> {
    /// What stands upright, about a place.
    Upright(SpaceUpright, Vector3),
    /// A ball about a place.
    Ball(f32, Vector3),
    /// A convex outline, drawn out to both sides of a depth.
    Prism {
        /// Its corners in the plane.
        corners: &'a [[f32; 2]],
        /// Where it is along the depth axis.
        z: f32,
        /// How far it reaches to both sides.
        half: f32,
    },
}

/// What something covers of the floor: x and z, about a place.
#[derive(Debug, Clone, Copy)]
pub enum SpaceFoot<'a> {
    /// A disc of a radius.
    Disc(f32),
    /// A convex polygon, at most 16 corners in the order of positive area.
    Polygon(&'a [[f32; 2]]),
}

impl SpaceFoot<'_> {
    fn foot(self) -> Foot {
        match self {
            SpaceFoot::Disc(radius) => Foot::disc(radius),
            SpaceFoot::Polygon(corners) => Foot::of(Polygon::new(corners.iter().copied())),
        }
    }

    /// Least and greatest x of what of it is between two z, as seen from its place.
    pub fn span(self, near: f32, far: f32) -> Option<[f32; 2]> {
        self.foot().span(near, far)
    }

    /// How far it is from another one at a place as seen from its own, negative where they overlap; and the direction to it.
    pub fn gap(self, other: SpaceFoot<'_>, at: [f32; 2]) -> (f32, [f32; 2]) {
        let gap = self.foot().gap(&other.foot(), at);
        (gap.apart, gap.normal)
    }

    /// The highest place of a box, y down, over it at a place; and the direction out of the box there.
    pub fn roof(self, at: [f32; 2], shape: &SlantedBox) -> Option<(f32, Vector3)> {
        roof_over(shape, &self.foot(), at)
    }
}

/// How far two are apart of which one at least is upright; negative where they overlap. Of two others nothing is known: they are
/// infinitely far apart.
pub fn apart_in_space(one: SpaceForm<'_>, other: SpaceForm<'_>) -> f32 {
    let mut corners = Corners::default();
    let upright = |form: &SpaceForm<'_>| match form {
        SpaceForm::Upright(upright, _) => Some(Upright::new(*upright)),
        _ => None,
    };
    let uprights = [upright(&one), upright(&other)];
    let shapes = [one, other].map(|form| match form {
        SpaceForm::Upright(upright, _) => {
            let (middle, half) = upright.front();
            corners.add_box_at(middle, half)
        }
        SpaceForm::Ball(radius, _) => corners.add_ball(radius),
        SpaceForm::Prism { corners: outline, .. } => corners.add_hull(&simplified(outline.to_vec())),
    });
    let solids = [0, 1].map(|at| {
        let (kind, [x, y, z]) = match [one, other][at] {
            SpaceForm::Upright(_, place) => (Kind::Upright, place.into()),
            SpaceForm::Ball(_, place) => (Kind::Ball, place.into()),
            SpaceForm::Prism { z, half, .. } => (Kind::Prism(half), [0.0, 0.0, z]),
        };
        Solid {
            outline: corners.outline(shapes[at]),
            pose: [x, y, 1.0, 0.0],
            kind,
            z,
            motion: [0.0; 3],
            ahead: [0.0; 3],
            slant: None,
            upright: uprights[at].as_ref(),
        }
    });
    standing::separation(solids[0], solids[1]).0
}
