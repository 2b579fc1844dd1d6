//! The scalar operations: their types and their one canonical definition.

/// The type of a scalar. Angles are reals in radians, inks are ints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Type {
    Bool,
    Int,
    Real,
}

/// A scalar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    Bool(bool),
    Int(i32),
    Real(f64),
}

impl Value {
    /// Its type.
    pub fn ty(self) -> Type {
        match self {
            Value::Bool(_) => Type::Bool,
            Value::Int(_) => Type::Int,
            Value::Real(_) => Type::Real,
        }
    }

    /// As a real: ints widen, true is 1.
    #[inline]
    pub fn real(self) -> f64 {
        match self {
            Value::Bool(b) => f64::from(u8::from(b)),
            Value::Int(i) => f64::from(i),
            Value::Real(r) => r,
        }
    }

    /// As an int: reals truncate and saturate.
    #[inline]
    pub fn int(self) -> i32 {
        match self {
            Value::Bool(b) => i32::from(b),
            Value::Int(i) => i,
            Value::Real(r) => r as i32,
        }
    }

    /// As a condition: whatever is not 0 is true.
    #[inline]
    pub fn truth(self) -> bool {
        match self {
            Value::Bool(b) => b,
            Value::Int(i) => i != 0,
            Value::Real(r) => r != 0.0,
        }
    }
}

macro_rules! ops {
    ($($(#[$doc:meta])* $name:ident $text:literal ($($arg:ident),*) -> $result:ident;)*) => {
        /// A scalar operation. Every operation is total: it has a value for
        /// every argument (LANGUAGE, "Exact meanings"); [`Op::eval`] defines it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Op { $($(#[$doc])* $name,)* }

        impl Op {
            /// Every operation.
            pub const EVERY: &'static [Op] = &[$(Op::$name,)*];

            /// Those that scenes are made of, which every runtime has: all but the last two,
            /// which a plan's own rewriting makes for runtimes that have them.
            pub const ALL: &'static [Op] = Op::EVERY.split_at(Op::EVERY.len() - 2).0;

            /// Its name in printed graphs.
            pub fn name(self) -> &'static str {
                match self { $(Op::$name => $text,)* }
            }

            /// The types of its arguments.
            #[inline]
            pub fn args(self) -> &'static [Type] {
                match self { $(Op::$name => &[$(Type::$arg,)*],)* }
            }

            /// The type of its result.
            #[inline]
            pub fn result(self) -> Type {
                match self { $(Op::$name => Type::$result,)* }
            }
        }
    };
}

ops! {
    Add "add" (Real, Real) -> Real;
    Sub "sub" (Real, Real) -> Real;
    Mul "mul" (Real, Real) -> Real;
    /// x/0 is the largest value with x's sign, 0/0 is 0.
    Div "div" (Real, Real) -> Real;
    Neg "neg" (Real) -> Real;
    Abs "abs" (Real) -> Real;
    Min "min" (Real, Real) -> Real;
    Max "max" (Real, Real) -> Real;
    /// Of a negative: 0.
    Sqrt "sqrt" (Real) -> Real;
    /// a - b floor(a/b); 0 where b is 0.
    Mod "mod" (Real, Real) -> Real;
    Sin "sin" (Real) -> Real;
    Cos "cos" (Real) -> Real;
    Tan "tan" (Real) -> Real;
    /// Arguments clamp to -1..1.
    Asin "asin" (Real) -> Real;
    /// Arguments clamp to -1..1.
    Acos "acos" (Real) -> Real;
    /// The angle of (y, x), y first.
    Atan2 "atan2" (Real, Real) -> Real;
    Exp "exp" (Real) -> Real;
    /// Natural; of 0 or a negative: the most negative value.
    Log "log" (Real) -> Real;
    /// Of a negative to a fraction: 0.
    Pow "pow" (Real, Real) -> Real;
    Floor "floor" (Real) -> Int;
    /// Half away from zero.
    Round "round" (Real) -> Int;
    /// -1, 0 or 1.
    Sign "sign" (Real) -> Int;
    ToReal "to_real" (Int) -> Real;
    Less "lt" (Real, Real) -> Bool;
    LessEqual "le" (Real, Real) -> Bool;
    Equal "eq" (Real, Real) -> Bool;
    IntAdd "iadd" (Int, Int) -> Int;
    IntSub "isub" (Int, Int) -> Int;
    IntMul "imul" (Int, Int) -> Int;
    /// Floors; by 0: the largest value with the dividend's sign, 0/0 is 0.
    IntDiv "idiv" (Int, Int) -> Int;
    /// Floors, so it has the divisor's sign; 0 where the divisor is 0.
    IntMod "imod" (Int, Int) -> Int;
    IntNeg "ineg" (Int) -> Int;
    IntAbs "iabs" (Int) -> Int;
    IntMin "imin" (Int, Int) -> Int;
    IntMax "imax" (Int, Int) -> Int;
    IntSign "isign" (Int) -> Int;
    /// Two's complement.
    BitAnd "and" (Int, Int) -> Int;
    BitOr "or" (Int, Int) -> Int;
    BitXor "xor" (Int, Int) -> Int;
    IntLess "ilt" (Int, Int) -> Bool;
    IntLessEqual "ile" (Int, Int) -> Bool;
    IntEqual "ieq" (Int, Int) -> Bool;
    Not "not" (Bool) -> Bool;
    /// The root of an int as it is; of a negative: 0. Where ints have more bits than reals.
    IntRoot "int_root" (Int) -> Real;
    /// One over the root; of what is not above 0: the largest value.
    ReciprocalRoot "reciprocal_root" (Real) -> Real;
}

/// Keeps a real finite: overflow saturates, what is no number is 0.
#[inline]
fn finite(x: f64) -> f64 {
    if x.is_nan() {
        0.0
    } else {
        x.clamp(f64::MIN, f64::MAX)
    }
}

#[inline]
fn div(a: f64, b: f64) -> f64 {
    match b == 0.0 {
        true if a == 0.0 => 0.0,
        true => f64::MAX.copysign(a),
        false => a / b,
    }
}

/// The remainder with the divisor's sign; `%` is exact, so this errs by at most the last sum.
#[inline]
fn modulus(a: f64, b: f64) -> f64 {
    match b == 0.0 {
        true => 0.0,
        false => {
            let rest = a % b;
            if rest != 0.0 && (rest < 0.0) != (b < 0.0) {
                rest + b
            } else {
                rest
            }
        }
    }
}

#[inline]
fn int_div(a: i32, b: i32) -> i32 {
    match b {
        0 if a == 0 => 0,
        0 if a > 0 => i32::MAX,
        0 => i32::MIN,
        _ => {
            let (a, b) = (i64::from(a), i64::from(b));
            let floored = a / b - i64::from(a % b != 0 && (a < 0) != (b < 0));
            i32::try_from(floored).unwrap_or(i32::MAX)
        }
    }
}

#[inline]
fn int_mod(a: i32, b: i32) -> i32 {
    if b == 0 {
        return 0;
    }
    let (a, b) = (i64::from(a), i64::from(b));
    let rest = a % b;
    (if rest != 0 && (rest < 0) != (b < 0) {
        rest + b
    } else {
        rest
    }) as i32
}

impl Op {
    /// How many arguments it takes.
    #[inline]
    pub fn arity(self) -> usize {
        self.args().len()
    }

    /// Whether its two arguments may change places.
    pub fn commutes(self) -> bool {
        use Op::*;
        let reals = matches!(self, Add | Mul | Min | Max | Equal);
        reals
            || matches!(
                self,
                IntAdd | IntMul | IntMin | IntMax | IntEqual | BitAnd | BitOr | BitXor
            )
    }

    /// An operation by its printed name.
    pub fn named(name: &str) -> Option<Op> {
        Op::EVERY.iter().copied().find(|op| op.name() == name)
    }

    /// The operation in `f64` (transcendentals from `libm`, so that every host
    /// agrees) and saturating `i32`. Missing arguments count as 0.
    pub fn eval(self, args: &[Value]) -> Value {
        let at = |k: usize| args.get(k).copied().unwrap_or(Value::Int(0));
        match self.args().first() {
            Some(Type::Real) => self.eval_real(at(0).real(), at(1).real()),
            Some(Type::Int) => self.eval_int(at(0).int(), at(1).int()),
            _ => Value::Bool(!at(0).truth()),
        }
    }

    /// An operation on reals; 0 for any other. Inlined, so that a loop over one
    /// known operation holds that one alone.
    #[inline(always)]
    pub fn eval_real(self, a: f64, b: f64) -> Value {
        let real = |x| Value::Real(finite(x));
        match self {
            Op::Add => real(a + b),
            Op::Sub => real(a - b),
            Op::Mul => real(a * b),
            Op::Div => real(div(a, b)),
            Op::Neg => real(-a),
            Op::Abs => real(a.abs()),
            Op::Min => real(if b < a { b } else { a }),
            Op::Max => real(if b > a { b } else { a }),
            Op::Sqrt => real(if a > 0.0 { a.sqrt() } else { 0.0 }),
            Op::ReciprocalRoot => real(if a > 0.0 { a.sqrt().recip() } else { f64::MAX }),
            Op::Mod => real(modulus(a, b)),
            Op::Sin => real(libm::sin(a)),
            Op::Cos => real(libm::cos(a)),
            Op::Tan => real(libm::tan(a)),
            Op::Asin => real(libm::asin(a.clamp(-1.0, 1.0))),
            Op::Acos => real(libm::acos(a.clamp(-1.0, 1.0))),
            Op::Atan2 => real(libm::atan2(a, b)),
            Op::Exp => real(libm::exp(a)),
            Op::Log => real(libm::log(a.max(0.0))),
            Op::Pow => real(libm::pow(a, b)),
            Op::Floor => Value::Int(a.floor() as i32),
            Op::Round => Value::Int(a.round() as i32),
            Op::Sign => Value::Int(i32::from(a > 0.0) - i32::from(a < 0.0)),
            Op::Less => Value::Bool(a < b),
            Op::LessEqual => Value::Bool(a <= b),
            Op::Equal => Value::Bool(a == b),
            _ => real(0.0),
        }
    }

    /// An operation on ints; 0 for any other.
    #[inline(always)]
    pub fn eval_int(self, a: i32, b: i32) -> Value {
        Value::Int(match self {
            Op::ToReal => return Value::Real(f64::from(a)),
            Op::IntRoot => return Value::Real(f64::from(a.max(0)).sqrt()),
            Op::IntLess => return Value::Bool(a < b),
            Op::IntLessEqual => return Value::Bool(a <= b),
            Op::IntEqual => return Value::Bool(a == b),
            Op::IntAdd => a.saturating_add(b),
            Op::IntSub => a.saturating_sub(b),
            Op::IntMul => a.saturating_mul(b),
            Op::IntDiv => int_div(a, b),
            Op::IntMod => int_mod(a, b),
            Op::IntNeg => a.saturating_neg(),
            Op::IntAbs => a.saturating_abs(),
            Op::IntMin => a.min(b),
            Op::IntMax => a.max(b),
            Op::IntSign => a.signum(),
            Op::BitAnd => a & b,
            Op::BitOr => a | b,
            Op::BitXor => a ^ b,
            _ => 0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integer_division_floors_and_saturates() {
        let div = |a, b| Op::IntDiv.eval(&[Value::Int(a), Value::Int(b)]).int();
        let rem = |a, b| Op::IntMod.eval(&[Value::Int(a), Value::Int(b)]).int();
        for (a, b, q, r) in [
            (-7, 2, -4, 1),
            (7, -2, -4, -1),
            (-7, -2, 3, -1),
            (6, -2, -3, 0),
        ] {
            assert_eq!((div(a, b), rem(a, b)), (q, r), "{a} div {b}");
        }
        assert_eq!((div(i32::MIN, -1), rem(i32::MIN, -1)), (i32::MAX, 0));
        assert_eq!((div(5, 0), div(-5, 0), div(0, 0)), (i32::MAX, i32::MIN, 0));
    }

    #[test]
    fn reals_have_a_value_for_every_argument() {
        let values = [0.0, -0.0, 1.5, -3.0, f64::MAX, f64::MIN, 1e-300];
        for op in Op::EVERY {
            for a in values {
                for b in values {
                    let result = op.eval(&[Value::Real(a), Value::Real(b)]);
                    assert!(result.real().is_finite(), "{op:?}({a}, {b}) = {result:?}");
                    assert_eq!(result.ty(), op.result(), "{op:?}");
                }
            }
        }
        assert_eq!(
            Op::Div.eval(&[Value::Real(-1.0), Value::Real(0.0)]),
            Value::Real(f64::MIN)
        );
        assert_eq!(Op::Sqrt.eval(&[Value::Real(-4.0)]), Value::Real(0.0));
    }
}
