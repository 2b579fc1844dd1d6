//! Vectors of three `f64`, for the renderers alone.

use std::ops::{Add, Mul, Sub};

/// A point or a direction: x right, y up, z towards the viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct V(pub f64, pub f64, pub f64);

impl Add for V {
    type Output = V;
    fn add(self, b: V) -> V {
        V(self.0 + b.0, self.1 + b.1, self.2 + b.2)
    }
}

impl Sub for V {
    type Output = V;
    fn sub(self, b: V) -> V {
        V(self.0 - b.0, self.1 - b.1, self.2 - b.2)
    }
}

impl Mul<V> for f64 {
    type Output = V;
    fn mul(self, b: V) -> V {
        V(self * b.0, self * b.1, self * b.2)
    }
}

impl V {
    pub fn dot(self, b: V) -> f64 {
        self.0 * b.0 + self.1 * b.1 + self.2 * b.2
    }

    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    pub fn unit(self) -> V {
        let n = self.length();
        V(self.0 / n, self.1 / n, self.2 / n)
    }

    pub fn cross(self, b: V) -> V {
        V(
            self.1 * b.2 - self.2 * b.1,
            self.2 * b.0 - self.0 * b.2,
            self.0 * b.1 - self.1 * b.0,
        )
    }
}
