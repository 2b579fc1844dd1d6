//! Types of the scene language, and which value may stand where which is wanted.

use super::ids::RecordId;

/// A type. Equal types hold the same values; [`Ty::fits`] says what widens.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Ty {
    Bool,
    Int,
    Real,
    /// A real in radians.
    Angle,
    /// An index into the palette.
    Ink,
    /// A vector of 2 or 3 reals.
    Vector(u8),
    Ray,
    /// A hit; with a tag's type where its scene is known.
    Hit(Option<Box<Ty>>),
    Shape,
    /// A scene; with its tags' type where it is known.
    Scene(Option<Box<Ty>>),
    Map,
    Table(Box<Ty>),
    Function(Vec<Ty>, Box<Ty>),
    Record(RecordId),
    Optional(Box<Ty>),
    /// No value: the type of `next`, and of what `none` does not hold.
    Never,
    /// Already reported; fits everywhere.
    Error,
}

impl Ty {
    /// `T?`, without doubling.
    pub fn optional(self) -> Ty {
        match self {
            Ty::Optional(_) | Ty::Error => self,
            other => Ty::Optional(Box::new(other)),
        }
    }

    /// Whether it is a number with an order: int, real, angle.
    pub fn is_number(&self) -> bool {
        matches!(self, Ty::Int | Ty::Real | Ty::Angle | Ty::Error)
    }

    /// Whether an int or a real (or already reported).
    pub fn is_real(&self) -> bool {
        matches!(self, Ty::Int | Ty::Real | Ty::Error)
    }

    /// Whether a value of this type may stand where `want` is wanted.
    pub fn fits(&self, want: &Ty) -> bool {
        match (self, want) {
            (Ty::Error | Ty::Never, _) | (_, Ty::Error) => true,
            (Ty::Int, Ty::Real) => true,
            (Ty::Optional(a), Ty::Optional(b)) => a.fits(b),
            (a, Ty::Optional(b)) => a.fits(b),
            (Ty::Table(a), Ty::Table(b)) => a.fits(b),
            (Ty::Hit(_), Ty::Hit(None)) | (Ty::Scene(_), Ty::Scene(None)) => true,
            (Ty::Hit(Some(a)), Ty::Hit(Some(b))) => a.fits(b),
            (a, b) => a == b,
        }
    }

    /// The least type that both fit.
    pub fn join(&self, other: &Ty) -> Option<Ty> {
        match (self, other) {
            (Ty::Error, _) | (_, Ty::Error) => Some(Ty::Error),
            (a, b) if a.fits(b) => Some(b.clone()),
            (a, b) if b.fits(a) => Some(a.clone()),
            (Ty::Optional(a), b) | (b, Ty::Optional(a)) => {
                let inner = match b {
                    Ty::Optional(b) => a.join(b)?,
                    b => a.join(b)?,
                };
                Some(inner.optional())
            }
            (Ty::Table(a), Ty::Table(b)) => Some(Ty::Table(Box::new(a.join(b)?))),
            (Ty::Hit(_), Ty::Hit(_)) => Some(Ty::Hit(None)),
            (Ty::Scene(_), Ty::Scene(_)) => Some(Ty::Scene(None)),
            _ => None,
        }
    }

    /// Whether values of it are made of scalars, so that a loop may carry them.
    pub fn is_data(&self) -> bool {
        match self {
            Ty::Optional(inner) => inner.is_data(),
            Ty::Shape | Ty::Scene(_) | Ty::Map | Ty::Table(_) | Ty::Function(..) => false,
            _ => true,
        }
    }
}
