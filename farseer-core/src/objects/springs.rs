//! Springs and their bodies (behaviour chapter 11).

use super::Objects;
use crate::body::BodyId;
use crate::error::{Error, Result};
use crate::springs::{Spring, SpringId, SpringType};

/// Springs.
impl Objects {
    /// Stores a spring. It acts once it is [added](Self::add).
    ///
    /// # Errors
    /// A body that is stale.
    pub(crate) fn create_spring(&mut self, spring: Spring) -> Result<SpringId> {
        self.check_body("body1", spring.body1())?;
        spring.body2().map_or(Ok(()), |body| self.check_body("body2", body))?;
        Ok(self.springs.create(spring))
    }

    /// Makes a spring of a kind without bodies, as the original's constructors without arguments do, for data that are
    /// read from a file one value after the other. Bodies are set by [`set_spring_body1`](Self::set_spring_body1) (also
    /// the only one) and [`set_spring_body2`](Self::set_spring_body2). Until they are set, both constants, points,
    /// lengths and angles are 0; all other settings have the defaults of the kind. The spring can be [added](Self::add)
    /// once it has its bodies.
    ///
    /// ```
    /// use farseer_core::{Body, Error, FixedLinearSpring, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::default();
    /// let lamp = simulator.create_body(Body::new());
    /// let cord = simulator.create_empty_spring::<FixedLinearSpring>();
    /// simulator[cord].set_spring_constant(30.0)?;
    /// assert_eq!(simulator.add(cord), Err(Error::MissingBody { argument: "spring", missing: "body" }));
    /// simulator.set_spring_body1(cord, lamp)?;
    /// simulator.spring_as_mut::<FixedLinearSpring>(cord)?.set_rest_length(12.0)?;
    /// simulator.add(cord)?;
    /// # Ok::<(), Error>(())
    /// ```
    #[doc(alias("AngleSpring()", "FixedAngleSpring()", "FixedLinearSpring()", "LinearSpring()"))]
    pub fn create_empty_spring<S: SpringType>(&mut self) -> SpringId {
        self.springs.create(S::without_bodies())
    }

    /// A spring, unless the id is stale.
    #[inline]
    pub fn spring(&self, spring: SpringId) -> Option<&Spring> {
        self.springs.get(spring)
    }

    /// A spring to edit, unless the id is stale.
    #[inline]
    pub fn spring_mut(&mut self, spring: SpringId) -> Option<&mut Spring> {
        self.springs.get_mut(spring)
    }

    /// A spring as its own type: `simulator.spring_as::<LinearSpring>(spring)?.rest_length()`.
    ///
    /// # Errors
    /// A stale id; a spring of another kind.
    pub fn spring_as<S: SpringType>(&self, spring: SpringId) -> Result<&S> {
        let argument = "spring";
        S::of(self.springs.find(argument, spring)?).ok_or(Error::WrongKind { argument, expected: S::NAME })
    }

    /// A spring as its own type, to edit.
    ///
    /// # Errors
    /// A stale id; a spring of another kind.
    pub fn spring_as_mut<S: SpringType>(&mut self, spring: SpringId) -> Result<&mut S> {
        let argument = "spring";
        S::of_mut(self.springs.find_mut(argument, spring)?)
            .ok_or(Error::WrongKind { argument, expected: S::NAME })
    }

    /// The springs that take part, in the order in which they were added.
    #[doc(alias = "SpringList")]
    pub fn spring_list(&self) -> &[SpringId] {
        self.springs.list()
    }

    /// Replaces the first or only body of a spring; its other settings stay.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias(
        "AngleSpring.Body1",
        "LinearSpring.Body1",
        "FixedAngleSpring.Body",
        "FixedLinearSpring.Body"
    ))]
    pub fn set_spring_body1(&mut self, spring: SpringId, body: BodyId) -> Result<()> {
        self.check_body("body", body)?;
        self.springs.find_mut("spring", spring)?.set_body1(body);
        Ok(())
    }

    /// Replaces the second body of a spring between two bodies.
    ///
    /// # Errors
    /// A stale id; a spring on one body.
    #[doc(alias("AngleSpring.Body2", "LinearSpring.Body2"))]
    pub fn set_spring_body2(&mut self, spring: SpringId, body: BodyId) -> Result<()> {
        self.check_body("body", body)?;
        let changed = self.springs.find_mut("spring", spring)?;
        if changed.body2().is_none() {
            return Err(Error::WrongKind { argument: "spring", expected: "spring between two bodies" });
        }
        changed.set_body2(body);
        Ok(())
    }

    /// Refuses a stale body.
    pub(super) fn check_body(&self, argument: &'static str, body: BodyId) -> Result<()> {
        if self.bodies.contains(body) { Ok(()) } else { Err(Error::StaleId { argument }) }
    }
}

impl std::ops::Index<SpringId> for Objects {
    type Output = Spring;
    /// # Panics
    /// If the id is stale; see [`Objects::spring`].
    fn index(&self, spring: SpringId) -> &Spring {
        &self.springs[spring]
    }
}

impl std::ops::IndexMut<SpringId> for Objects {
    /// # Panics
    /// If the id is stale; see [`Objects::spring_mut`].
    fn index_mut(&mut self, spring: SpringId) -> &mut Spring {
        &mut self.springs[spring]
    }
}
