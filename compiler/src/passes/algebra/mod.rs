//! Algebra over the reals: passes that compute the same values by other formulas.

pub mod angle_addition;
pub mod distribute;
mod formula;
pub mod identities;
pub mod polynomial;
pub mod ray_parameter;
pub mod reassociate;
pub mod root_of_choice;
pub mod unnormalised;
