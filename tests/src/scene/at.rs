//! Positions in a scene file, written as `bodies[3].shape.radius`.

use std::fmt;

/// A position in a scene file: the path from the top to a value. It borrows the path, and is only turned into text when there
/// is an error to report.
#[derive(Debug, Clone, Copy)]
pub enum At<'a> {
    /// The complete file.
    Root,
    /// The value of a key of an object.
    Key(&'a At<'a>, &'a str),
    /// An element of a list.
    Item(&'a At<'a>, usize),
}

impl<'a> At<'a> {
    /// The value of `key` in the object at this position.
    pub fn key(&'a self, key: &'a str) -> At<'a> {
        At::Key(self, key)
    }

    /// The element `index` of the list at this position.
    pub fn item(&'a self, index: usize) -> At<'a> {
        At::Item(self, index)
    }
}

impl fmt::Display for At<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            At::Root => Ok(()),
            At::Key(At::Root, key) => f.write_str(key),
            At::Key(parent, key) => write!(f, "{parent}.{key}"),
            At::Item(parent, index) => write!(f, "{parent}[{index}]"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::At;

    #[test]
    fn a_position_is_written_as_keys_and_indices() {
        let bodies = At::Root.key("bodies");
        let body = bodies.item(3);
        let shape = body.key("shape");
        assert_eq!(shape.key("radius").to_string(), "bodies[3].shape.radius");
    }
}
