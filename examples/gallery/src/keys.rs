//! Keys of any source: a keyboard, or a button on a screen.

/// A key or button.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Key {
    /// To the left; the left flipper.
    Left,
    /// To the right; the right flipper.
    Right,
    /// Away from the viewer.
    Up,
    /// Towards the viewer.
    Down,
    /// Jumps; launches the ball.
    Jump,
    /// Strikes.
    Punch,
    /// Lifts and throws.
    Grab,
    /// Pauses and resumes.
    Pause,
    /// One step.
    Step,
    /// Slow motion.
    Slow,
    /// Restarts the scene.
    Restart,
    /// Back in time, for as long as it is held.
    Rewind,
    /// The other set of methods.
    Methods,
    /// Outlines.
    Outlines,
    /// Boxes.
    Boxes,
    /// Contacts.
    Contacts,
    /// Islands by how they are solved.
    Islands,
    /// Marks on sleeping bodies.
    Sleep,
    /// Joints and springs.
    Joints,
    /// How long frames take.
    Graph,
    /// The list of keys.
    Help,
    /// All of the screen.
    Full,
    /// The list of scenes.
    List,
    /// The scene before.
    Before,
    /// The scene after.
    After,
}

/// A set of keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct KeySet(u32);

impl KeySet {
    /// Adds a key.
    pub fn insert(&mut self, key: Key) {
        self.0 |= 1 << key as u8;
    }

    /// Whether a key is in it.
    pub fn contains(self, key: Key) -> bool {
        self.0 >> key as u8 & 1 == 1
    }

    /// The keys that are in this set or in the other.
    pub fn or(self, other: KeySet) -> KeySet {
        KeySet(self.0 | other.0)
    }

    /// The keys that are in this set and not in the other.
    pub fn without(self, other: KeySet) -> KeySet {
        KeySet(self.0 & !other.0)
    }

    /// Whether the set is empty.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

impl FromIterator<Key> for KeySet {
    fn from_iter<I: IntoIterator<Item = Key>>(keys: I) -> Self {
        let mut set = KeySet::default();
        keys.into_iter().for_each(|key| set.insert(key));
        set
    }
}

/// Input of a game.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Keys {
    /// Keys that are down.
    pub held: KeySet,
    /// Keys that went down since the last step.
    pub pressed: KeySet,
}

impl Keys {
    /// -1, 0 or 1, by which of two keys is down.
    pub fn axis(self, less: Key, more: Key) -> f32 {
        f32::from(i8::from(self.held.contains(more)) - i8::from(self.held.contains(less)))
    }
}
