//! Simplification: values that are equal by algebra or by their ranges, in fewer operations.

pub mod bitwise;
pub mod constant_factors;
pub mod doubled_products;
pub mod fold;
pub mod function_tables;
pub mod integer_parts;
pub mod interpolated_tables;
pub mod quotient_tables;
pub mod range_folding;
pub mod reciprocals;
pub mod remainders;
pub mod unit_vectors;
