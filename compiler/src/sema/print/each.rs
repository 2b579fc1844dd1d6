//! Scenes' members, and what `each` joins.

use super::Printer;
use crate::sema::program::*;

impl Printer<'_> {
    /// A member on lines of its own, `deep` steps in.
    pub(super) fn member(&self, member: &Member, deep: usize) -> String {
        let lead = "  ".repeat(deep);
        match member {
            Member::One { shape, tag } => {
                let shape = self.expr(shape, &shape.value, deep);
                let tag = tag.as_ref().map(|tag| self.expr(tag, &tag.value, deep));
                let tag = tag.map_or(String::new(), |tag| format!(" is {tag}"));
                format!("{lead}{shape}{tag}\n")
            }
            Member::Each {
                name,
                low,
                high,
                members,
                ..
            } => {
                let low = self.expr(low, &low.value, deep);
                let high = self.expr(high, &high.value, deep);
                let inside = members.iter().map(|m| self.member(m, deep + 1));
                let inside: String = inside.collect();
                format!("{lead}each {name} in {low} .. {high} {{\n{inside}{lead}}}\n")
            }
        }
    }

    pub(super) fn each(&self, body: &Body, each: &Each, deep: usize) -> String {
        let call = match &each.join.kind {
            ExprKind::Convert(call) => &call.kind,
            call => call,
        };
        let (joined, more) = match call {
            ExprKind::Call { callee, args } => {
                let more = args.iter().skip(2).flatten();
                let more: Vec<String> = more.map(|a| self.expr(body, a, deep)).collect();
                (self.callee(body, callee), more)
            }
            _ => ("?".into(), Vec::new()),
        };
        let more = match more.is_empty() {
            true => String::new(),
            false => format!("({})", more.join(", ")),
        };
        let (low, high) = (&each.low, &each.high);
        let (low, high) = (self.expr(body, low, deep), self.expr(body, high, deep));
        let name = self.local(body, each.counter);
        let made = self.expr(body, &each.body, deep + 1);
        let lead = "  ".repeat(deep + 1);
        format!("{joined}{more} each {name} in {low} .. {high}\n{lead}{made}")
    }
}
