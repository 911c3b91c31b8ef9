//! Macros that name what exists and give its path as text.

/// Functions, constants and variants without parameters of their own.
macro_rules! paths {
    ($($path:path),* $(,)?) => {
        [$({
            let _ = $path;
            stringify!($path)
        }),*]
    };
}

/// Functions with their types.
macro_rules! typed {
    ($($path:path: $type:ty),* $(,)?) => {
        [$({
            let _: $type = $path;
            stringify!($path)
        }),*]
    };
}

/// Types that are not named by a member of theirs.
macro_rules! types {
    ($($type:path),*) => {
        [$({
            let _ = size_of::<$type>();
            stringify!($type)
        }),*]
    };
}

/// Public fields of a type, which can be read and written.
macro_rules! fields {
    ($type:path { $($field:ident),* }) => {
        [$({
            let _ = |value: &mut $type| value.$field = value.$field.clone();
            concat!(stringify!($type), ".", stringify!($field))
        }),*]
    };
}

/// Variants with fields.
macro_rules! variants {
    ($($variant:path),*) => {
        [$({
            let _ = |value| matches!(value, $variant { .. });
            stringify!($variant)
        }),*]
    };
}

/// Fields of a variant.
macro_rules! variant_fields {
    ($variant:path { $($field:ident),* }) => {
        [$({
            let _ = |value| matches!(value, $variant { $field: _, .. });
            concat!(stringify!($variant), ".", stringify!($field))
        }),*]
    };
}

/// Methods of a trait that a type implements.
macro_rules! methods {
    ($type:ty as $trait:path { $($method:ident),* }) => {
        [$({
            let _ = <$type as $trait>::$method;
            concat!(stringify!($trait), "::", stringify!($method))
        }),*]
    };
}
