//! Evaluations of a scene inside the compiler: the graph in `f64`, the plan in
//! the routines' models.

pub mod model;
pub mod native;
pub mod run;

#[cfg(test)]
mod tests;
