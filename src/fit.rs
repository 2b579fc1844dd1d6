//! Fit: a plan whose program the machine can hold, or how far that is from it.
//!
//! Sizes are those of the machine's own tools: the tokeniser's program and the
//! list entries of its names, the assembler's bytes. What only running would
//! tell is bounded: BASIC's stack, the heap of a Jack program at its start.
//! A program that does not fit as it reads best is tried once more, written as
//! tight as the target can; without `--mode`, the next mode is tried after that.
//! Where no mode that shows the whole picture holds it either way, they are tried
//! with subroutines for what the program has several times: slower, and much
//! smaller. Then come the modes that show a part of it, in the same way.

use crate::failure::{Failure, Outcome};
use crate::format::count;
use slowlight_compiler::flow::graph::Table;
use slowlight_compiler::flow::tree::{Statement, Tree, walk};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::source::Span;
use slowlight_compiler::target::Document;
use slowlight_vm::bbc::{Config, Dialect, Machine, tokenise};
use slowlight_vm::mos6502::{extent, plain::port};

/// What BASIC's stack takes at most: three calls of the runtime's functions
/// inside each other, of 28 bytes and 8 an argument, and as much as a call more
/// for what an expression holds meanwhile.
const BASIC_STACK: u64 = 160;

/// What a procedure without arguments leaves on it while it runs: the
/// processor's stack, and where to return to.
const BASIC_CALL: u64 = 28;

/// Words of the Hack computer's heap, and those that each object has beside its own.
const HEAP: u64 = 16384 - 2048;
const HEADER: u64 = 2;

/// What a program takes of a machine's memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Need {
    /// `bytes` or `words`.
    unit: &'static str,
    /// Each part and its size.
    parts: Vec<(&'static str, u64)>,
    /// What the machine has.
    room: u64,
}

impl Need {
    /// Everything together.
    pub fn total(&self) -> u64 {
        self.parts.iter().map(|(_, size)| size).sum()
    }

    /// Whether the machine holds it.
    pub fn fits(&self) -> bool {
        self.total() <= self.room
    }

    /// `6,120 of 5,888 bytes, 232 too many (program 5,300, ..)`.
    pub fn text(&self) -> String {
        let parts = self.parts.iter().filter(|(_, size)| *size > 0);
        let parts: Vec<String> = parts.map(|(n, s)| format!("{n} {}", count(*s))).collect();
        format!(
            "{} of {} {}, {} too many ({})",
            count(self.total()),
            count(self.room),
            self.unit,
            count(self.total().saturating_sub(self.room)),
            parts.join(", ")
        )
    }
}

/// What a plan's program takes; `None` where nothing is known of the machine.
///
/// # Errors
/// Where the machine's tools refuse the text, which is a fault of ours.
pub fn need(plan: &Plan) -> Outcome<Option<Need>> {
    let documents = (plan.target.emit)(plan);
    let dialect = match plan.target.name {
        "bbc:micro" => Dialect::Micro,
        "bbc:agon" => Dialect::Agon,
        "bbc:basicv" => Dialect::BasicV,
        "6502:plain" => return Ok(documents.first().map(assembly)),
        "jack" => return Ok(Some(heap(&documents))),
        _ => return Ok(None),
    };
    match documents.first() {
        Some(document) => basic(plan, document, dialect),
        None => Ok(None),
    }
}

fn basic(plan: &Plan, document: &Document, dialect: Dialect) -> Outcome<Option<Need>> {
    let refuse = |fault: slowlight_vm::Fault| {
        Failure::Wrong(format!("the tokeniser refuses {}: {fault}", document.name))
    };
    let tokens = tokenise(&document.text, dialect).map_err(refuse)?;
    let mut machine = Machine::new(Config {
        dialect,
        page: plan.page.unwrap_or(Config::default().page),
    });
    machine.load_tokenised(&tokens).map_err(refuse)?;
    let mode = plan.mode.name.parse().ok();
    let Some(room) = mode.and_then(|mode| machine.memory(mode)) else {
        return Ok(None);
    };
    Ok(Some(Need {
        unit: "bytes",
        parts: vec![
            ("program", machine.program_bytes() as u64),
            ("variables", machine.entry_bytes() as u64),
            ("arrays", arrays(&document.text)),
            ("stack", BASIC_STACK + BASIC_CALL * depth(&plan.tree)),
        ],
        room: room as u64,
    }))
}

/// How many subroutines run inside each other at most.
fn depth(tree: &Tree) -> u64 {
    let mut depths: Vec<u64> = vec![0; tree.subroutines.len()];
    // One that is called stands before or behind who calls it; no chain of
    // calls is longer than there are subroutines.
    for _ in 0..depths.len() {
        for (k, subroutine) in tree.subroutines.iter().enumerate() {
            let mut inner = 0;
            walk(&subroutine.body, &mut |statement| {
                if let Statement::Call(id) = statement {
                    inner = inner.max(depths.get(id.0 as usize).copied().unwrap_or(0));
                }
            });
            if let Some(depth) = depths.get_mut(k) {
                *depth = inner + 1;
            }
        }
    }
    depths.into_iter().max().unwrap_or(0)
}

/// Bytes of the arrays that a program makes with constant bounds.
fn arrays(text: &str) -> u64 {
    let mut bytes = 0;
    for (at, _) in text.match_indices("DIM") {
        let behind = text.get(at + 3..).unwrap_or_default();
        let Some((name, rest)) = behind.split_once('(') else {
            continue;
        };
        let bounds = rest.split_once(')').map_or("", |(inside, _)| inside);
        let bounds: Vec<u64> = bounds.split(',').filter_map(|n| n.parse().ok()).collect();
        let element = if name.ends_with('%') { 4 } else { 5 };
        let elements: u64 = bounds.iter().map(|n| n + 1).product();
        bytes += 1 + 2 * bounds.len() as u64 + element * elements;
    }
    bytes
}

fn assembly(document: &Document) -> Need {
    let (origin, end) = extent(&document.text);
    Need {
        unit: "bytes",
        parts: vec![
            ("values and the runtime's tables", u64::from(origin)),
            ("program", u64::from(end.saturating_sub(origin))),
        ],
        room: u64::from(port::WIDTH),
    }
}

/// The heap of a Jack program before it draws: one object of fields, Floats and
/// arrays. Rows of errors are made in a loop, one Float an element.
fn heap(documents: &[Document]) -> Need {
    let (mut fields, mut floats, mut arrays, mut rows) = (0, 0, 0, 0);
    // Behind `Main` comes the scene's class.
    let scene = documents.get(1).map_or("", |d| d.text.as_str());
    for line in scene.lines().map(str::trim_start) {
        if let Some(declared) = line.strip_prefix("field ") {
            let names = declared.split(';').next().unwrap_or_default();
            fields += names.split(',').count() as u64;
        } else if let Some((_, size)) = line.split_once("= Array.new(") {
            let size = size.split(')').next().and_then(|n| n.parse::<u64>().ok());
            let size = size.unwrap_or(0);
            arrays += size + HEADER;
            if line.starts_with("let errors") {
                rows += size;
            }
        } else if line.contains("= Float.constant(") || line.contains("= Float.new(") {
            floats += 1;
        }
    }
    let float = 3 + HEADER;
    Need {
        unit: "words",
        parts: vec![
            ("fields", fields + HEADER),
            ("numbers", floats * float),
            ("tables", arrays),
            ("errors", rows * float),
        ],
        room: HEAP,
    }
}

/// The first of the plans whose program fits, as it reads best or tight; where
/// none does, the first that does with subroutines. Modes that show a part of the
/// picture only come after all that is tried for those that show the whole.
/// `name` says what the scene calls what stands at a place of it.
///
/// # Errors
/// Where none does: how far each is from it, and what would help.
pub fn fit(
    plans: impl IntoIterator<Item = Outcome<Plan>>,
    name: &dyn Fn(Span) -> Option<String>,
) -> Outcome<Plan> {
    let mut large: Vec<(Plan, Need)> = Vec::new();
    let mut tried = None;
    for plan in plans {
        let plan = plan?;
        if tried.is_none() && crops(&plan) {
            if let Some(fits) = outlined(&mut large, name)? {
                return Ok(fits);
            }
            tried = Some(large.len());
        }
        if let Some(fits) = quickest(&plan)? {
            return Ok(fits);
        }
        // None of these fits as it is.
        let least = plan.thriftier(plan.thrifts().saturating_sub(1));
        let mut found = as_is_or_tight(least.unwrap_or(plan))?;
        // Rather slower than with fewer inks.
        while let Fitted::TooLarge(plan, _) = &found
            && let Some(smaller) = plan.smaller()
        {
            found = as_is_or_tight(smaller)?;
        }
        match found {
            Fitted::Fits(plan) => return Ok(*plan),
            Fitted::TooLarge(plan, need) => large.push((*plan, need)),
        }
    }
    if let Some(fits) = outlined(&mut large[tried.unwrap_or(0)..], name)? {
        return Ok(fits);
    }
    let mut said = String::new();
    for (plan, least) in &large {
        let mode = match plan.mode.name {
            "" => String::new(),
            name => format!("mode {name}: "),
        };
        said.push_str(&format!("\n  {mode}{}", least.text()));
    }
    let Some((plan, _)) = large.last() else {
        return Err(Failure::Wrong("there is no mode to draw in".to_owned()));
    };
    Err(Failure::Wrong(format!(
        "{} does not fit {}:{said}\n{}",
        plan.name,
        plan.target.name,
        help(plan)
    )))
}

/// Whether the screen shows a part of the picture only.
fn crops(plan: &Plan) -> bool {
    let image = &plan.graph.image;
    plan.mode.width < image.width || plan.mode.height < image.height
}

/// The first of the plans that fits with subroutines; where none does, what each
/// takes at least is noted.
fn outlined(
    large: &mut [(Plan, Need)],
    name: &dyn Fn(Span) -> Option<String>,
) -> Outcome<Option<Plan>> {
    for (plan, least) in large {
        // A fault of the plan with subroutines would be one of the plan without.
        let Ok(outlined) = plan.outlined(name) else {
            continue;
        };
        match as_is_or_tight(outlined)? {
            Fitted::Fits(plan) => return Ok(Some(*plan)),
            Fitted::TooLarge(_, need) if need.total() < least.total() => *least = need,
            Fitted::TooLarge(..) => {}
        }
    }
    Ok(None)
}

/// A plan that fits, or how large its smallest program is.
enum Fitted {
    Fits(Box<Plan>),
    TooLarge(Box<Plan>, Need),
}

/// The plan, or the quickest of those that spend less memory on speed that fits as
/// it is: what is written short is slower. Each step takes less memory than those
/// before it, or nearly so.
fn quickest(plan: &Plan) -> Outcome<Option<Plan>> {
    let fits = |plan: &Plan| Ok(need(plan)?.is_none_or(|need| need.fits()));
    if fits(plan)? {
        return Ok(Some(plan.clone()));
    }
    let (mut large, mut small) = (0, plan.thrifts());
    let mut found = None;
    while small - large > 1 {
        let middle = (large + small) / 2;
        match plan.thriftier(middle) {
            Some(tried) if fits(&tried)? => (small, found) = (middle, Some(tried)),
            _ => large = middle,
        }
    }
    Ok(found)
}

fn as_is_or_tight(mut plan: Plan) -> Outcome<Fitted> {
    let mut least: Option<Need> = None;
    let styles = [(false, false), (true, false), (true, true)];
    // What is to be read stays so, rather slower, while it can be smaller.
    let count = if plan.listing && plan.may_be_smaller() {
        1
    } else {
        3
    };
    for (lean, tight) in styles.into_iter().take(count) {
        (plan.lean, plan.tight) = (lean, tight);
        match need(&plan)? {
            Some(need) if !need.fits() => {
                if least.as_ref().is_none_or(|l| need.total() < l.total()) {
                    least = Some(need);
                }
            }
            _ => return Ok(Fitted::Fits(Box::new(plan))),
        }
        // Steps take a few bytes; to write it short costs more than they save.
        let mut less = if lean { None } else { plan.unstepped() };
        while let Some(plain) = less {
            if need(&plain)?.is_some_and(|need| need.fits()) {
                return Ok(Fitted::Fits(Box::new(plain)));
            }
            less = plain.unstepped();
        }
    }
    Ok(match least {
        Some(need) => Fitted::TooLarge(Box::new(plan), need),
        None => Fitted::Fits(Box::new(plan)),
    })
}

/// What makes a program smaller.
fn help(plan: &Plan) -> String {
    let mut ways = Vec::new();
    let effects: Vec<&str> = plan.graph.effects.iter().map(|e| e.name.as_str()).collect();
    if !effects.is_empty() {
        ways.push(format!(
            "leave an effect out (--without {})",
            effects.join(", ")
        ));
    }
    if !plan.params.is_empty() {
        ways.push("fold the params (--freeze all)".to_owned());
    }
    if plan.graph.diffusion.is_some() {
        ways.push("dither by a matrix, which keeps no rows of errors".to_owned());
    }
    let large = |t: &Table| t.entries.len() > 1000;
    if plan.graph.tables.iter().any(large) {
        ways.push("make tables smaller".to_owned());
    }
    ways.push("draw fewer shapes, or more of one kind: what is alike is written once".to_owned());
    format!("what would help: {}", ways.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_are_counted_as_the_machine_makes_them() {
        assert_eq!(arrays("10DIM a(7,7):b=1"), 5 + 5 * 64);
        assert_eq!(arrays("10DIMn%(3):DIM error(9,1)"), 3 + 16 + 5 + 100);
        assert_eq!(arrays("10PRINT"), 0);
    }

    #[test]
    fn a_need_says_how_far_it_is_off() {
        let need = Need {
            unit: "bytes",
            parts: vec![("program", 5000), ("arrays", 0), ("variables", 1000)],
            room: 5888,
        };
        assert!(!need.fits());
        assert_eq!(
            need.text(),
            "6,000 of 5,888 bytes, 112 too many (program 5,000, variables 1,000)"
        );
    }
}
