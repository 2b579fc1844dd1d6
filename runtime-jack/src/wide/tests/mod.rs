//! How far wide Floats are from the exact results.
