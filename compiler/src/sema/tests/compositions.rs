//! Random compositions of the library's shapes, the same in every run.

/// Kinds of shapes, as how many of the list are of them.
#[derive(Clone, Copy, PartialEq)]
enum Of {
    /// Those that have a distance, too.
    Distance = 4,
    /// Those that have an inside.
    Solid = 6,
    /// And surfaces that are cut off.
    Any = 8,
}

/// Numbers by a linear congruential generator (Knuth's MMIX).
struct Random(u64);

impl Random {
    /// A number below another.
    fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n
    }

    /// A number of hundredths.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        let part = self.below(1001) as f64 / 1000.0;
        ((low + (high - low) * part) * 100.0).round() / 100.0
    }

    fn place(&mut self, most: f64) -> String {
        let [x, y, z] = [0; 3].map(|_: i32| self.between(-most, most));
        format!("({x}, {y}, {z})")
    }

    fn size(&mut self) -> f64 {
        self.between(0.2, 1.5)
    }

    /// One of the library's shapes, of such a kind.
    fn single(&mut self, of: Of) -> String {
        let (at, size, other) = (self.place(1.0), self.size(), self.size());
        match self.below(of as usize) {
            0 => format!("sphere({at}, {size})"),
            1 => {
                let third = self.size();
                format!("box((-{size}, -{other}, -{third}), ({other}, {third}, {size}))")
            }
            2 => format!("torus({at}, {}, {})", 1.0 + size, 0.2 + other / 4.0),
            3 => format!("spindle({at}, {size}, {other})"),
            4 => format!("quadric({at}, ({size}, {other}, 1))"),
            5 => format!("superquadric({at}, ({size}, {other}, 1), 4)"),
            6 => format!("clip(cylinder({at}, (0, 1, 0), {size}), slab(-{other}, {size}))"),
            _ => format!("clip(cone((0, {size}, 0), (0, -1, 0), 30deg), slab(-{other}, {size}))"),
        }
    }

    /// A shape of a kind, made of others so many levels deep.
    fn shape(&mut self, deep: usize, of: Of) -> String {
        if deep == 0 {
            return self.single(of);
        }
        let made = self.below(10);
        let of = match made {
            0..3 => Of::Distance,
            3..6 if of == Of::Any => Of::Solid,
            _ => of,
        };
        let a = self.shape(deep - 1, of);
        let width = self.between(0.05, 0.3);
        match made {
            0 => format!("onion({a}, {})", self.between(0.05, 0.2)),
            1 => format!("smooth_union({a}, {}, {width})", self.single(of)),
            2 => format!("smooth_difference({a}, {}, {width})", self.single(of)),
            3 => format!("union({a}, {})", self.single(of)),
            4 => format!("difference({a}, {})", self.single(of)),
            5 => format!("intersection({a}, {})", self.single(of)),
            6 => format!("{a}.rotation((0.6, 0.48, 0.64), {}deg)", self.below(360)),
            7 => format!("{a}.rotation((0, 1, 0), {}deg)", self.below(360)),
            8 => format!("{a}.scaling({})", self.between(0.5, 2.0)),
            _ => format!("{a}.translation({})", self.place(2.0)),
        }
    }
}

/// So many of them, as a scene writes them.
pub fn compositions(count: usize) -> Vec<String> {
    let mut random = Random(32);
    (0..count)
        .map(|k| random.shape(1 + k % 3, Of::Any))
        .collect()
}
