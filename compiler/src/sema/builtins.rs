//! What the language itself can call: operations over scalars, and what the
//! compiler derives for shapes, scenes, tables and maps. Everything else is the library's,
//! written in the language.

use super::ty::Ty;
use slowlight_routine::Op;

/// An operation of the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builtin {
    /// A scalar operation.
    Op(Op),
    /// The ink of a number, clamped to the palette.
    Ink,
    /// The n x n ordered-dither matrix over n^2; n a power of two.
    Bayer,
    /// The inks that are nearest to the cells of a cube of colours.
    NearestInks,
    /// How far the palette's levels of a primary are apart.
    InkStep,
    /// A ray from a point; the direction has length 1 by contract.
    Ray,
    /// A hit from its point, unit normal and distance along the ray; what a
    /// shape's own solution may give.
    Hit,
    /// Entries of a table.
    Count,
    /// The nearest hit of a shape.
    ShapeHit,
    /// A distance before which a ray meets no surface that a shape is made of.
    ShapeCrossing,
    /// A bool that may be taken for false where that costs less.
    Early,
    /// The unit normal of a shape at a point of its surface.
    ShapeNormal,
    /// The signed distance of a point from a shape.
    ShapeDist,
    /// A shape's implicit function.
    ShapeImplicit,
    /// The nearest hit of a scene.
    Trace,
    /// Whether a ray hits anything.
    Blocked,
    /// Sphere tracing.
    March,
    /// The distance of a point from a scene.
    SceneDist,
    /// The tag of what is nearest to a point.
    SceneTag,
}

impl Builtin {
    /// How the printed program writes it.
    pub fn text(self) -> String {
        match self {
            Builtin::Op(op) => op.name().to_owned(),
            Builtin::Ink => "ink".into(),
            Builtin::Bayer => "bayer".into(),
            Builtin::NearestInks => "nearest_inks".into(),
            Builtin::InkStep => "ink_step".into(),
            Builtin::Ray => "ray".into(),
            Builtin::Hit => "hit".into(),
            Builtin::Count => "count".into(),
            Builtin::Early => "early".into(),
            Builtin::ShapeHit => "shape.hit".into(),
            Builtin::ShapeCrossing => "shape.crossing".into(),
            Builtin::ShapeNormal => "shape.normal".into(),
            Builtin::ShapeDist => "shape.dist".into(),
            Builtin::ShapeImplicit => "shape.f".into(),
            Builtin::Trace => "scene.trace".into(),
            Builtin::Blocked => "scene.blocked".into(),
            Builtin::March => "scene.march".into(),
            Builtin::SceneDist => "scene.dist".into(),
            Builtin::SceneTag => "scene.tag".into(),
        }
    }
}

/// A parameter of a builtin: its name, type and whether a call may leave it out.
pub struct Param(pub &'static str, pub Ty, pub bool);

/// One way to call a builtin.
pub struct Signature {
    /// Its name in scenes.
    pub name: &'static str,
    /// What it does.
    pub builtin: Builtin,
    /// Its parameters.
    pub params: Vec<Param>,
    /// Its result; hits and tags of a scene take their tag from the argument.
    pub result: Ty,
}

fn need(name: &'static str, ty: Ty) -> Param {
    Param(name, ty, false)
}

/// Every way to call every builtin, exact types before those that widen.
pub fn signatures() -> Vec<Signature> {
    use Ty::*;
    let mut all = Vec::new();
    let mut add = |name, builtin, params, result| {
        all.push(Signature {
            name,
            builtin,
            params,
            result,
        });
    };
    let one = |name: &'static str, ty: Ty| vec![need(name, ty)];
    for (name, int, real) in [("min", Op::IntMin, Op::Min), ("max", Op::IntMax, Op::Max)] {
        for (ty, op) in [(Int, int), (Real, real), (Angle, real)] {
            let params = vec![need("a", ty.clone()), need("b", ty.clone())];
            add(name, Builtin::Op(op), params, ty);
        }
    }
    for (ty, op) in [(Int, Op::IntAbs), (Real, Op::Abs), (Angle, Op::Abs)] {
        add("abs", Builtin::Op(op), one("a", ty.clone()), ty);
    }
    for (ty, op) in [(Int, Op::IntSign), (Real, Op::Sign), (Angle, Op::Sign)] {
        add("sign", Builtin::Op(op), one("a", ty), Int);
    }
    add("floor", Builtin::Op(Op::Floor), one("a", Real), Int);
    add("round", Builtin::Op(Op::Round), one("a", Real), Int);
    add("sqrt", Builtin::Op(Op::Sqrt), one("a", Real), Real);
    add("exp", Builtin::Op(Op::Exp), one("a", Real), Real);
    add("log", Builtin::Op(Op::Log), one("a", Real), Real);
    for (name, op) in [("sin", Op::Sin), ("cos", Op::Cos), ("tan", Op::Tan)] {
        add(name, Builtin::Op(op), one("a", Angle), Real);
    }
    for (name, op) in [("asin", Op::Asin), ("acos", Op::Acos)] {
        add(name, Builtin::Op(op), one("a", Real), Angle);
    }
    let pair = |a, b, ty: Ty| vec![need(a, ty.clone()), need(b, ty)];
    add("atan2", Builtin::Op(Op::Atan2), pair("y", "x", Real), Angle);
    add("early", Builtin::Early, one("c", Bool), Bool);
    for (name, op) in [
        ("bit_and", Op::BitAnd),
        ("bit_or", Op::BitOr),
        ("bit_xor", Op::BitXor),
    ] {
        add(name, Builtin::Op(op), pair("a", "b", Int), Int);
    }
    add("ink", Builtin::Ink, one("i", Int), Ink);
    add(
        "bayer",
        Builtin::Bayer,
        one("n", Int),
        Table(Box::new(Real)),
    );
    let inks = Table(Box::new(Int));
    add("nearest_inks", Builtin::NearestInks, one("side", Int), inks);
    add("ink_step", Builtin::InkStep, one("primary", Int), Real);
    add("ray", Builtin::Ray, pair("from", "dir", Vector(3)), Ray);
    add(
        "count",
        Builtin::Count,
        one("table", Table(Box::new(Error))),
        Int,
    );

    let hit = || Optional(Box::new(Hit(None)));
    let on = |of: Ty, rest: Vec<Param>| {
        let mut params = vec![need("self", of)];
        params.extend(rest);
        params
    };
    let far = || Param("far", Real, true);
    let mut parts = pair("point", "normal", Vector(3));
    parts.push(need("t", Real));
    add("hit", Builtin::Hit, parts, Hit(None));
    add("hit", Builtin::ShapeHit, on(Shape, one("r", Ray)), hit());
    add(
        "crossing",
        Builtin::ShapeCrossing,
        on(Shape, one("r", Ray)),
        Optional(Box::new(Real)),
    );
    add(
        "normal",
        Builtin::ShapeNormal,
        on(Shape, one("p", Vector(3))),
        Vector(3),
    );
    add(
        "dist",
        Builtin::ShapeDist,
        on(Shape, one("p", Vector(3))),
        Real,
    );
    add(
        "f",
        Builtin::ShapeImplicit,
        on(Shape, one("p", Vector(3))),
        Real,
    );
    let scene = || Scene(None);
    add(
        "trace",
        Builtin::Trace,
        on(scene(), vec![need("r", Ray), far()]),
        hit(),
    );
    add(
        "blocked",
        Builtin::Blocked,
        on(scene(), vec![need("r", Ray), far()]),
        Bool,
    );
    let march = vec![
        need("r", Ray),
        need("steps", Int),
        need("near", Real),
        need("far", Real),
    ];
    add("march", Builtin::March, on(scene(), march), hit());
    add(
        "dist",
        Builtin::SceneDist,
        on(scene(), one("p", Vector(3))),
        Real,
    );
    add(
        "tag",
        Builtin::SceneTag,
        on(scene(), one("p", Vector(3))),
        Error,
    );
    all
}
