//! Axis-aligned bounding boxes (behaviour chapter 05, section 2).
