//! Surfaces that may lie on each other: of such the shape that is named later is seen, so they
//! keep their order.
//!
//! Two irreducible surfaces of different families (spheres, cylinders, planes) share curves at
//! most, and which of two is seen along a curve shows nowhere. Cones and tori may degenerate into
//! planes and spheres.

use super::value::{Shape, Val};
use super::{Found, Lower};
use std::rc::Rc;

/// A family of surfaces.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Family {
    Spheres,
    Cylinders,
    Planes,
}

/// What a shape of the library that is made of numbers alone is bounded by.
fn family(name: &str) -> Option<Family> {
    Some(match name {
        "sphere" => Family::Spheres,
        "cylinder" => Family::Cylinders,
        "plane" | "slab" | "box" | "polygon" => Family::Planes,
        _ => return None,
    })
}

impl Lower<'_> {
    /// Whether parts of two shapes' surfaces may be the same.
    pub(super) fn may_coincide(&mut self, a: &Rc<Shape>, b: &Rc<Shape>) -> Found<bool> {
        let (mut of_a, mut of_b) = (Vec::new(), Vec::new());
        if !self.surfaces(a, &mut of_a)? || !self.surfaces(b, &mut of_b)? {
            return Ok(true);
        }
        Ok(of_a.iter().any(|family| of_b.contains(family)))
    }

    /// The families of a shape's surfaces; false where one is not known.
    fn surfaces(&mut self, shape: &Rc<Shape>, found: &mut Vec<Family>) -> Found<bool> {
        let item = self.program.shapes.get(shape.id.0);
        let Some(item) = item.filter(|item| item.library) else {
            return Ok(false);
        };
        if let Some(family) = family(&item.name) {
            found.push(family);
            return Ok(true);
        }
        // What moves, cuts or joins shapes leaves parts of theirs; a region that cuts is not seen.
        let parts = match item.name.as_str() {
            "clip" | "translation" | "rotation" | "scaling" => 1,
            "union" | "intersection" | "difference" => 2,
            _ => return Ok(false),
        };
        for arg in shape.args.iter().take(parts) {
            match self.force(arg.clone())? {
                Val::Shape(part) if self.surfaces(&part, found)? => {}
                _ => return Ok(false),
            }
        }
        Ok(true)
    }
}
