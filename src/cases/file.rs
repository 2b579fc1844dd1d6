//! Files of hard cases: kernels, inputs, wanted values, and when a result passes.
//!
//! Keys that only document (formulas, sources, notes) are not read.

use crate::failure::{Failure, Outcome};
use serde::Deserialize;
use serde_json::Value as Json;
use std::collections::BTreeMap;

/// A whole file.
#[derive(Debug, Deserialize)]
pub struct CaseFile {
    /// Kernels by family.
    pub families: BTreeMap<String, Family>,
    /// The cases.
    pub vectors: Vec<Vector>,
}

/// What is hard in one way.
#[derive(Debug, Deserialize)]
pub struct Family {
    /// Kernels by name.
    pub entry: BTreeMap<String, Entry>,
}

/// A kernel and how it is called.
#[derive(Debug, Deserialize)]
pub struct Entry {
    /// Name, parameters and results, as the library would write them.
    pub sig: String,
    /// For each parameter a scalar, or a list of them for a vector: the name of
    /// an input, the same with a minus sign, or a decimal.
    pub args: BTreeMap<String, Argument>,
    /// Inputs that are integers and never rounded.
    #[serde(default)]
    pub ints: Vec<String>,
    /// The results' names, in order.
    pub outputs: Vec<String>,
}

/// What fills a parameter.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub enum Argument {
    /// A scalar.
    One(String),
    /// A vector's components.
    Many(Vec<String>),
}

/// One case.
#[derive(Debug, Deserialize)]
pub struct Vector {
    /// Family and tag.
    pub id: String,
    /// Which kernel of the family.
    pub entry: String,
    /// The exact inputs.
    pub inputs: BTreeMap<String, Input>,
    /// What is wanted of them.
    #[serde(flatten)]
    pub wanted: Wanted,
    /// What is wanted of the inputs rounded to so many bits.
    #[serde(default)]
    pub expected_by_bits: BTreeMap<String, Overlay>,
    /// What is wanted of the inputs rounded to a fixed-point format.
    #[serde(default)]
    pub expected_by_quantum: BTreeMap<String, Overlay>,
    /// The params that the inputs are, in formats that have to know how large a value may
    /// become: the usual value, the least and the greatest.
    #[serde(default)]
    pub params: BTreeMap<String, [f64; 3]>,
    /// What is wanted of them rounded to a format of that name. Without an entry nothing is
    /// known of the vector there.
    #[serde(default)]
    pub expected_by_format: BTreeMap<String, Overlay>,
}

/// An input's exact value.
#[derive(Debug, Deserialize)]
pub struct Input {
    /// As a decimal.
    pub dec: String,
}

/// Wanted results, and when a result passes.
#[derive(Clone, Debug, Deserialize)]
pub struct Wanted {
    /// By output: a decimal, an integer, a list of cells, or null.
    pub expected: BTreeMap<String, Json>,
    /// What passes.
    pub predicate: Predicate,
}

/// What differs where the inputs are rounded.
#[derive(Debug, Deserialize)]
pub struct Overlay {
    expected: Option<BTreeMap<String, Json>>,
    predicate: Option<Predicate>,
    /// Why the case says nothing in this format.
    pub reason: Option<String>,
}

impl Vector {
    /// The family's name.
    pub fn family(&self) -> &str {
        self.id.split_once('/').map_or(&self.id, |(f, _)| f)
    }

    /// What is wanted where `overlay` says how the inputs were rounded.
    pub fn wanted(&self, overlay: Option<&Overlay>) -> Wanted {
        let mut wanted = self.wanted.clone();
        if let Some(Overlay {
            expected,
            predicate,
            ..
        }) = overlay
        {
            if let Some(expected) = expected {
                wanted.expected.clone_from(expected);
            }
            if let Some(predicate) = predicate {
                wanted.predicate = predicate.clone();
            }
        }
        wanted
    }
}

/// When a result passes. `u` is the format's unit roundoff.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Predicate {
    /// |got - want| <= tiny + k u max(1, cond) |want|; without `cond` always.
    Rel {
        output: String,
        k: f64,
        cond: Option<f64>,
        #[serde(default)]
        kq: Option<f64>,
    },
    /// |got - want| <= tiny + slack + k u^pow scale.
    Abs {
        output: String,
        k: f64,
        scale: f64,
        pow: f64,
        #[serde(default)]
        slack: f64,
        #[serde(default)]
        kq: Option<f64>,
    },
    /// The signs agree, or `got` is 0 where that is allowed.
    Sign { output: String, zero: Json },
    /// Integers or lists of cells agree.
    Equal { output: String },
    /// Integers, or all those in lists of cells, differ by so much at most.
    Near { output: String, by: f64 },
    /// lo - k u scale <= got <= hi + k u scale; `*` is every output.
    Interval {
        output: String,
        lo: f64,
        hi: f64,
        k: f64,
        scale: f64,
    },
    /// |sum of squares - 1| <= k u.
    UnitVector { outputs: Vec<String>, k: f64 },
    /// The outputs are three vectors of length 1, perpendicular and right-handed within k u.
    Orthonormal { k: f64 },
    /// There is a result (or there is none).
    Present { value: bool },
    /// There is no result, or it passes.
    IfPresent { predicate: Box<Predicate> },
    /// Too close to call (margin <= k u), or it passes.
    Decided {
        margin: f64,
        k: f64,
        predicate: Box<Predicate>,
    },
    /// It passes; or the format cannot hold 2^(hi-1) or 2^lo, and this was said.
    RefuseOr {
        hi: i32,
        lo: i32,
        predicate: Box<Predicate>,
    },
    /// All pass.
    All { of: Vec<Predicate> },
}

/// A file of cases from its text.
///
/// # Errors
/// Where it is not of this form.
pub fn parse(name: &str, text: &str) -> Outcome<CaseFile> {
    serde_json::from_str(text)
        .map_err(|why| Failure::Wrong(format!("{name} is no file of hard cases: {why}")))
}
