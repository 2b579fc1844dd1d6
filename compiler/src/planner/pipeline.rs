//! The pass pipeline: every pass that the planner runs, in the order in which it does.
//!
//! A pass goes from a plan's graph to another of the same picture. Some always apply; most are
//! kept where the plan's price falls ([`crate::cost::price`]), and some are of one kind of machine.
//! What runs them is a [`Pipeline`](super::pass_manager::Pipeline).

use crate::analysis::range::Ranges;
use crate::ir::graph::Graph;
use crate::passes::algebra::root_of_choice::root_of_choice;
use crate::passes::branches::cross_multiply::cross_multiply;
use crate::passes::branches::prune_minima::prune_minima;
use crate::passes::loops::polynomials::differences::forward_differences;
use crate::passes::loops::polynomials::polynomials;
use crate::passes::loops::trip_counts::trip_counts;
use crate::passes::simplify::bitwise::bitwise;
use crate::passes::simplify::constant_factors::constant_factors;
use crate::passes::simplify::doubled_products::doubled_products;
use crate::passes::simplify::function_tables::function_tables;
use crate::passes::simplify::interpolated_tables::interpolated_tables;
use crate::passes::simplify::quotient_tables::quotient_tables;
use crate::passes::simplify::reciprocals::reciprocals;
use crate::passes::simplify::remainders::remainders;
use slowlight_routine::Runtime;

/// Declares [`Pass`] and what there is to say of each: its name, the file that has it, and what
/// it does in the field's terms.
macro_rules! passes {
    ($($pass:ident $name:literal $file:literal $what:literal)*) => {
        /// A pass, in the order of the pipeline.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Pass { $(
            #[doc = $what]
            $pass,
        )* }

        /// All of them.
        pub const PASSES: &[Pass] = &[$(Pass::$pass),*];

        impl Pass {
            /// Its name on the command line, the file in `compiler/src` that has it, and what
            /// it does.
            pub fn about(self) -> (&'static str, &'static str, &'static str) {
                match self { $(Pass::$pass => ($name, $file, $what),)* }
            }
        }
    };
}

passes! {
    Instances "instances" "sema/lower/instances" "shapes alike but for numbers as a table, found by a loop or by cells"
    Bounds "bounds" "sema/lower/bounds" "bounding boxes of shapes that are found by their distances"
    StripMine "strip-mine" "passes/loops/strip_mine" "strip-mining of rows by the residue of the column"
    IntegerParts "integer-parts" "passes/simplify/integer_parts" "integers out of floors, where sums have few bits"
    AccuracyRules "accuracy-rules" "passes/accuracy" "rewriting for accuracy, by rules with conditions"
    UnitVectors "unit-vectors" "passes/simplify/unit_vectors" "lengths of unit vectors folded"
    SquareComparisons "square-comparisons" "passes/branches/square_comparisons" "roots compared by their squares"
    AngleAddition "angle-addition" "passes/algebra/angle_addition" "sines of an arc's multiples by addition theorems"
    IntegerTables "integer-tables" "passes/loops/induction_tables" "tables of functions of integers of few values"
    Unroll "unroll" "passes/loops/unroll" "full unrolling of counted loops"
    Collect "collect" "passes/loops/collect" "polynomials collected by what hangs on a counter"
    InductionTables "induction-tables" "passes/loops/induction_tables" "tables of functions of induction variables"
    PushIntoSelect "push-into-select" "passes/branches/push_into_select" "operations sunk into the arms of selects"
    EarlyExit "early-exit" "passes/branches/early_exit" "early exits that the scene declares"
    RayParameter "ray-parameter" "passes/algebra/ray_parameter" "points on rays by the ray's parameter"
    LoopGuard "loop-guard" "passes/loops/guard" "loop guards before a loop and its second turn"
    InvertMonotone "invert-monotone" "passes/branches/invert_monotone" "comparisons before monotone functions"
    PolynomialForms "polynomial-forms" "passes/algebra/polynomial" "normal forms over polynomials and roots"
    Unnormalised "unnormalised" "passes/algebra/unnormalised" "directions at their own length"
    SpecialiseFactors "specialise-factors" "passes/branches/specialise_factors" "value specialisation of factors"
    LengthTests "length-tests" "passes/algebra/identities" "comparisons decided by the length of a vector"
    Identities "identities" "passes/algebra/identities" "shorter forms by identities of vectors"
    ScanlineSpans "scanline-spans" "passes/algebra/polynomial/span" "comparisons solved for spans of columns"
    Shannon "shannon" "passes/branches/shannon" "Shannon expansion of the ink's comparisons"
    TripCounts "trip-counts" "passes/loops/trip_counts" "loops ended by the count of their turns"
    LoopPolynomials "loop-polynomials" "passes/loops/polynomials" "polynomials of what a loop's turns change, by coefficients"
    ForwardDifferences "forward-differences" "passes/loops/polynomials/differences" "polynomials of what grows evenly from turn to turn, by forward differences"
    CrossMultiply "cross-multiply" "passes/branches/cross_multiply" "comparisons without division"
    RootOfChoice "root-of-choice" "passes/algebra/root_of_choice" "choices among roots as one root"
    PruneMinima "prune-minima" "passes/branches/prune_minima" "branch and bound on minima and maxima"
    ConstantFactors "constant-factors" "passes/simplify/constant_factors" "constant factors joined"
    Remainders "remainders" "passes/simplify/remainders" "remainders by constants as differences"
    FunctionTables "function-tables" "passes/simplify/function_tables" "tables of functions of one real of a short range or a period"
    InterpolatedTables "interpolated-tables" "passes/simplify/interpolated_tables" "tables of sines with lines between their entries"
    Bitwise "bitwise" "passes/simplify/bitwise" "bitwise operations of what is added up bit by bit"
    QuotientTables "quotient-tables" "passes/simplify/quotient_tables" "tables of integer quotients and remainders by constants"
    Reciprocals "reciprocals" "passes/simplify/reciprocals" "division as multiplication by a shared reciprocal"
    DoubledProducts "doubled-products" "passes/simplify/doubled_products" "doubled products as products with a doubled factor"
    Phases "phases" "passes/loops/strength_reduction" "phase accumulators for periodic functions of the column"
    ScanlineRuns "scanline-runs" "passes/loops/strength_reduction/runs" "values stepped along runs of columns"
    Reassociate "reassociate" "passes/algebra/reassociate" "reassociation and common subexpressions of sums"
    Unswitch "unswitch" "passes/branches/unswitch" "unswitching of the ink on one comparison"
    LoopBypass "loop-bypass" "passes/loops/bypass" "zero-trip bypass of loops"
    Rematerialise "rematerialise" "passes/rematerialise" "rematerialisation where values are needed"
    Distribute "distribute" "passes/algebra/distribute" "products with sums of what changes less often, term by term"
    ScalarExpansion "scalar-expansion" "passes/loops/scalar_expansion" "arrays of values of the column"
    Licm "licm" "passes/loops/licm" "loop-invariant code motion by frequency"
    WordLengths "word-lengths" "wordlength/precision" "fewer bits for values where the picture allows"
}

/// What makes another graph of the same picture; nothing where there is nothing to do.
pub type Rewrite = fn(&Graph, &Ranges, &Runtime) -> Option<Graph>;

/// The passes that only rewrite a graph, each kept where the plan's price falls: what is added
/// here needs no other place in the planner.
pub const REWRITES: &[(Pass, Rewrite)] = &[
    (Pass::TripCounts, trip_counts),
    (Pass::LoopPolynomials, polynomials),
    (Pass::ForwardDifferences, forward_differences),
    (Pass::CrossMultiply, cross_multiply),
    (Pass::RootOfChoice, root_of_choice),
    (Pass::PruneMinima, prune_minima),
    (Pass::ConstantFactors, constant_factors),
    (Pass::Remainders, remainders),
    (Pass::FunctionTables, function_tables),
    (Pass::InterpolatedTables, interpolated_tables),
    (Pass::Bitwise, bitwise),
    (Pass::QuotientTables, quotient_tables),
    (Pass::Reciprocals, reciprocals),
    (Pass::DoubledProducts, doubled_products),
];
