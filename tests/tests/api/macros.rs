//! Macros that use the names of a table, and give their paths as text.

/// Functions and constants; a generic one has the type that is meant.
macro_rules! value {
    ($path:path: $type:ty) => {{
        let _: $type = $path;
        stringify!($path)
    }};
}

/// Types that are not named by a member of theirs.
macro_rules! a_type {
    ($type:path) => {{
        let _ = size_of::<$type>();
        stringify!($type)
    }};
}

/// Public fields of a type, which can be read and written.
macro_rules! field {
    ($type:path, $field:ident) => {{
        let _ = |value: &mut $type| value.$field = value.$field.clone();
        concat!(stringify!($type), ".", stringify!($field))
    }};
}

/// Variants, with fields or without.
macro_rules! variant {
    ($variant:path) => {{
        let _ = |value| matches!(value, $variant { .. });
        stringify!($variant)
    }};
}

/// Fields of a variant.
macro_rules! variant_field {
    ($variant:path, $field:ident) => {{
        let _ = |value| matches!(value, $variant { $field: _, .. });
        concat!(stringify!($variant), ".", stringify!($field))
    }};
}

/// Methods of a trait that a type implements.
macro_rules! method {
    ($type:ty as $trait:path, $method:ident) => {{
        let _ = <$type as $trait>::$method;
        concat!(stringify!($trait), "::", stringify!($method))
    }};
}
