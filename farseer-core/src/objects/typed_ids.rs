//! Ids with the type of the object that they name.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

use super::Objects;
use crate::Result;
use crate::joints::{JointId, JointType};
use crate::object_id::ObjectId;
use crate::springs::{SpringId, SpringType};

macro_rules! typed_ids {
    ($(
        $(#[$doc:meta])*
        $typed:ident: $id:ident, $kind:ident, $check:ident, $edit:ident
    )*) => {$(
        $(#[$doc])*
        pub struct $typed<K> {
            id: $id,
            kind: PhantomData<fn() -> K>,
        }

        impl<K> $typed<K> {
            /// The id without its kind, for the operations that all kinds share.
            #[inline]
            pub fn id(self) -> $id {
                self.id
            }
        }

        impl<K> Clone for $typed<K> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<K> Copy for $typed<K> {}

        impl<K> PartialEq for $typed<K> {
            fn eq(&self, other: &Self) -> bool {
                self.id == other.id
            }
        }

        impl<K> Eq for $typed<K> {}

        impl<K> Hash for $typed<K> {
            fn hash<H: Hasher>(&self, state: &mut H) {
                self.id.hash(state);
            }
        }

        impl<K> fmt::Debug for $typed<K> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.id.fmt(f)
            }
        }

        impl<K> From<$typed<K>> for $id {
            fn from(typed: $typed<K>) -> Self {
                typed.id
            }
        }

        impl<K> From<$typed<K>> for ObjectId {
            fn from(typed: $typed<K>) -> Self {
                typed.id.into()
            }
        }

        impl<K: $kind> Index<$typed<K>> for Objects {
            type Output = K;
            /// # Panics
            /// If the id is stale.
            fn index(&self, typed: $typed<K>) -> &K {
                self.$check(typed.id).unwrap_or_else(|error| panic!("{:?}: {error}", typed.id))
            }
        }

        impl<K: $kind> IndexMut<$typed<K>> for Objects {
            /// # Panics
            /// If the id is stale.
            fn index_mut(&mut self, typed: $typed<K>) -> &mut K {
                self.$edit(typed.id).unwrap_or_else(|error| panic!("{:?}: {error}", typed.id))
            }
        }
    )*};
}

typed_ids! {
    /// Id of a joint of a known kind, made by [`Objects::typed_joint`] and used as an index. Save the [plain
    /// id](Self::id), and ask for the kind again after loading. Not in the original.
    TypedJointId: JointId, JointType, joint_as, joint_as_mut

    /// Id of a spring of a known kind, made by [`Objects::typed_spring`] and used as an index. Save the [plain
    /// id](Self::id), and ask for the kind again after loading. Not in the original.
    ///
    /// ```
    /// use farseer_core::{BodyFactory, FixedLinearSpring, PhysicsSimulator, SpringFactory, TypedSpringId, math::Vector2};
    ///
    /// struct Flipper { spring: TypedSpringId<FixedLinearSpring> }
    ///
    /// let mut simulator = PhysicsSimulator::default();
    /// let body = BodyFactory::create_rectangle_body_in(&mut simulator, 40.0, 10.0, 1.0)?;
    /// let (here, there) = (Vector2::new(0.0, 0.0), Vector2::new(0.0, 30.0));
    /// let spring = SpringFactory::create_fixed_linear_spring_in(&mut simulator, body, here, there, 100.0, 5.0)?;
    /// let flipper = Flipper { spring: simulator.typed_spring(spring)? };
    /// simulator[flipper.spring].set_rest_length(10.0)?;
    /// assert_eq!(simulator[flipper.spring].rest_length(), 10.0);
    /// simulator[flipper.spring.id()].set_enabled(false);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    TypedSpringId: SpringId, SpringType, spring_as, spring_as_mut
}

impl Objects {
    /// A joint's id with its kind, so that indexing returns the joint as its own type: `simulator[hinge]`.
    ///
    /// # Errors
    /// A stale id; a joint of another kind.
    pub fn typed_joint<J: JointType>(&self, joint: JointId) -> Result<TypedJointId<J>> {
        self.joint_as::<J>(joint)?;
        Ok(TypedJointId { id: joint, kind: PhantomData })
    }

    /// A spring's id with its kind, so that indexing returns the spring as its own type: `simulator[spring]`.
    ///
    /// # Errors
    /// A stale id; a spring of another kind.
    pub fn typed_spring<S: SpringType>(&self, spring: SpringId) -> Result<TypedSpringId<S>> {
        self.spring_as::<S>(spring)?;
        Ok(TypedSpringId { id: spring, kind: PhantomData })
    }
}
