//! What is to be known of a plan beside its code. Data, not text: the command
//! line renders it.

pub mod bounces;
#[cfg(test)]
mod bounces_tests;
pub mod bounded;
pub mod domain;
pub mod effects;
pub mod fragile;
pub mod frontier;
pub mod inks;
pub mod missed;
pub mod profile;
#[cfg(test)]
mod profile_tests;
pub mod raised;
mod shadow;
#[cfg(test)]
mod tests;
pub mod words;
