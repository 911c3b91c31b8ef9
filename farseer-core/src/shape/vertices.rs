//! A list of vertices (behaviour chapter 05, section 1).
