//! Links between the bodies of a path (behaviour chapter 14, section 7).

use serde::{Deserialize, Serialize};

use crate::body::{Body, BodyId};
use crate::joints::{Joint, JointId, JointKind, PinJoint, RevoluteJoint, SliderJoint};
use crate::math::Vector2;
use crate::math::finite::finite;
use crate::math::vector2::distance;
use crate::objects::Objects;
use crate::shape::Vertices;
use crate::springs::{LinearSpring, Spring, SpringId, SpringKind};
use crate::{Error, Result};

const BIAS_FACTOR: f32 = 0.2;
const SOFTNESS: f32 = 0.01;

/// Kind of joint or spring that links neighbours of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum LinkType {
    /// Neighbours turn about a common point.
    RevoluteJoint,
    /// Neighbours keep a fixed distance.
    PinJoint,
    /// Neighbours keep a distance in a range.
    SliderJoint,
    /// A spring pulls or pushes neighbours to a distance.
    LinearSpring,
}

/// Settings of the links of a path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinkSettings {
    pub(crate) link_type: LinkType,
    /// Range of the distance of slider joints, in length units.
    pub(crate) min: f32,
    pub(crate) max: f32,
    pub(crate) spring_constant: f32,
    pub(crate) damping_constant: f32,
    pub(crate) spring_rest_length_factor: f32,
}

/// New joints and springs that are not in the simulator yet.
#[derive(Default)]
pub(super) struct NewLinks {
    pub(super) joints: Vec<Joint>,
    pub(super) springs: Vec<Spring>,
}

/// The bodies to link, and the joints and springs that the path had before.
#[derive(Clone, Copy)]
pub(super) struct BodyRow<'a> {
    pub(super) simulator: &'a Objects,
    pub(super) bodies: &'a [BodyId],
    pub(super) joints: &'a [JointId],
    pub(super) springs: &'a [SpringId],
    /// Width of a body, in length units.
    pub(super) width: f32,
    pub(super) endless: bool,
}

/// Rule for the length of a pin joint, and for the rest length of a spring.
#[derive(Clone, Copy)]
enum LinkLength {
    /// The length that the constructor computes.
    Measured,
    /// The distance of both anchors on the body that is shared with the link at this index of the list, each in that
    /// body's coordinates. As in the original this is no distance between two bodies.
    After(usize),
    /// The width of a body.
    Width,
}

/// A body at one end of a link, and the anchor in the body's coordinates.
#[derive(Clone, Copy)]
struct LinkEnd<'a> {
    id: BodyId,
    body: &'a Body,
    anchor: Vector2,
}

impl LinkSettings {
    /// Refuses numbers that are not finite.
    pub(crate) fn check(&self) -> Result<()> {
        finite("min", self.min)?;
        finite("max", self.max)?;
        finite("spring_constant", self.spring_constant)?;
        finite("damping_constant", self.damping_constant)?;
        finite("spring_rest_length_factor", self.spring_rest_length_factor)?;
        Ok(())
    }

    /// Links every body with the next, and the last with the first if the row is endless.
    pub(super) fn make(&self, row: BodyRow<'_>) -> Result<NewLinks> {
        self.check()?;
        let mut linked = NewLinks::default();
        let half = row.width / 2.0;
        for (index, pair) in row.bodies.windows(2).enumerate() {
            let [a, b] = [row.body(pair[0])?, row.body(pair[1])?];
            let side = if a.position().x < b.position().x { half } else { -half };
            let (a, b) = (LinkEnd::new(pair[0], a, side), LinkEnd::new(pair[1], b, -side));
            let length = index.checked_sub(1).map_or(LinkLength::Measured, LinkLength::After);
            self.link(row, a, b, length, &mut linked)?;
        }
        if row.endless {
            let (Some(&first), Some(&last)) = (row.bodies.first(), row.bodies.last()) else {
                return Err(Error::invalid("bodies", 0, "at least one body: the path is endless"));
            };
            let (a, b) =
                (LinkEnd::new(first, row.body(first)?, -half), LinkEnd::new(last, row.body(last)?, half));
            self.link(row, a, b, LinkLength::Width, &mut linked)?;
        }
        Ok(linked)
    }

    fn link(
        &self,
        row: BodyRow<'_>,
        a: LinkEnd<'_>,
        b: LinkEnd<'_>,
        length: LinkLength,
        linked: &mut NewLinks,
    ) -> Result<()> {
        let (first, second) = ((a.id, a.body), (b.id, b.body));
        let mut joint = match self.link_type {
            LinkType::RevoluteJoint => {
                let middle = Vertices::find_midpoint(a.body.position(), b.body.position());
                RevoluteJoint::new(first, second, middle)?
            }
            LinkType::PinJoint => {
                let mut joint = PinJoint::new(first, a.anchor, second, b.anchor)?;
                if let JointKind::Pin(pin) = joint.kind_mut() {
                    match length {
                        LinkLength::Measured => {}
                        LinkLength::Width => pin.set_target_distance(row.width)?,
                        LinkLength::After(index) => {
                            let before = row.pin(index, linked)?;
                            pin.set_target_distance(distance(before.anchor2(), a.anchor))?;
                        }
                    }
                }
                joint
            }
            LinkType::SliderJoint => SliderJoint::new(first, a.anchor, second, b.anchor, self.min, self.max)?,
            LinkType::LinearSpring => {
                let spring = self.spring(row, a, b, length, linked)?;
                linked.springs.push(spring);
                return Ok(());
            }
        };
        joint.set_bias_factor(BIAS_FACTOR)?;
        joint.set_softness(SOFTNESS)?;
        linked.joints.push(joint);
        Ok(())
    }

    fn spring(
        &self,
        row: BodyRow<'_>,
        a: LinkEnd<'_>,
        b: LinkEnd<'_>,
        length: LinkLength,
        linked: &NewLinks,
    ) -> Result<Spring> {
        let (first, second) = ((a.id, a.body), (b.id, b.body));
        let (k, d) = (self.spring_constant, self.damping_constant);
        let mut spring = LinearSpring::new(first, a.anchor, second, b.anchor, k, d)?;
        if let SpringKind::Linear(linear) = spring.kind_mut() {
            match length {
                LinkLength::Measured => {}
                LinkLength::Width => linear.set_rest_length(row.width)?,
                LinkLength::After(index) => {
                    let gap = distance(row.spring(index, linked)?.attach_point2(), a.anchor);
                    linear.set_rest_length(gap * self.spring_rest_length_factor)?;
                }
            }
        }
        Ok(spring)
    }
}

impl<'a> BodyRow<'a> {
    fn body(&self, body: BodyId) -> Result<&'a Body> {
        self.simulator.body(body).ok_or(Error::StaleId { argument: "bodies" })
    }

    /// The joint at an index of the whole list: first the old joints, then the new ones.
    fn pin<'b>(&'b self, index: usize, linked: &'b NewLinks) -> Result<&'b PinJoint> {
        match self.joints.get(index) {
            Some(&joint) => self.simulator.joint_as(joint),
            None => match linked.joints.get(index - self.joints.len()).map(Joint::kind) {
                Some(JointKind::Pin(pin)) => Ok(pin),
                _ => Err(Error::WrongKind { argument: "joints", expected: "PinJoint" }),
            },
        }
    }

    fn spring<'b>(&'b self, index: usize, linked: &'b NewLinks) -> Result<&'b LinearSpring> {
        match self.springs.get(index) {
            Some(&spring) => self.simulator.spring_as(spring),
            None => match linked.springs.get(index - self.springs.len()).map(Spring::kind) {
                Some(SpringKind::Linear(spring)) => Ok(spring),
                _ => Err(Error::WrongKind { argument: "springs", expected: "LinearSpring" }),
            },
        }
    }
}

impl<'a> LinkEnd<'a> {
    fn new(id: BodyId, body: &'a Body, side: f32) -> Self {
        LinkEnd { id, body, anchor: Vector2::new(side, 0.0) }
    }
}
