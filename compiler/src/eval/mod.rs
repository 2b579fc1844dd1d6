//! Evaluations of a scene inside the compiler: the graph in `f64`, the plan in
//! the routines' models.

pub mod arithmetic;
pub mod diffuse;
pub mod heard;
pub mod native;
pub mod neighbours;
mod places;
pub mod run;

#[cfg(test)]
pub(crate) mod drawn;
#[cfg(test)]
mod lane_tests;
#[cfg(test)]
pub(crate) mod random;
#[cfg(test)]
pub(crate) mod random_graphs;
#[cfg(test)]
mod scalar;
#[cfg(test)]
mod spread_tests;
#[cfg(test)]
mod tests;
