//! Ways that few pixels take, out of the others' way.
//!
//! BASIC II looks for the line that a jump names from the program's first on. What
//! stands behind END is passed by no jump that stays before it.

use super::{Item, Label, Later, Lines};

/// A block of fewer lines and labels stays where it is.
const FEW: usize = 4;

/// A line that jumps.
pub(super) fn jump(to: Label) -> Item {
    Item::Line {
        text: format!("GOTO {to}"),
        span: None,
        later: Later::new(),
        open: false,
        weight: 1,
    }
}

/// Whether what stands behind some lines may be come to from the last of them.
pub(super) fn goes_on(items: &[Item]) -> bool {
    let text = items.iter().rev().find_map(|item| match item {
        Item::Line { text, .. } => Some(text),
        Item::Label(_) => None,
    });
    text.is_none_or(|text| {
        let jumps = Label::last_of(text).is_some_and(|(before, _)| before.ends_with("GOTO "));
        text.contains("IF ") || !jumps
    })
}

/// The first of the labels that name the same line as the one at a place.
pub(super) fn first_label(items: &[Item], at: usize) -> usize {
    let before = items.iter().take(at).rev();
    at - before.take_while(|i| matches!(i, Item::Label(_))).count()
}

impl Lines {
    /// The lines with blocks behind the program's END, each given by a label before and one
    /// behind it: jumps look through all lines before their own, so others are quicker.
    pub fn away(mut self, blocks: &[(Label, Label)]) -> Lines {
        for &(from, to) in blocks {
            let labels = |items: &[Item], of| {
                let mut all = items.iter();
                let at = all.position(|item| matches!(item, Item::Label(label) if *label == of));
                at.map(|at| first_label(items, at))
            };
            let end = |item: &Item| matches!(item, Item::Line { text, .. } if text == "END");
            let (Some(first), Some(behind), Some(end)) = (
                labels(&self.items, from),
                labels(&self.items, to),
                self.items.iter().position(end),
            ) else {
                continue;
            };
            if !(first + FEW < behind && behind < end) {
                continue;
            }
            let mut tail = self.items.split_off(end + 1);
            let rest = self.items.split_off(behind);
            let block = self.items.split_off(first);
            if goes_on(&self.items) {
                self.items.push(jump(from));
            }
            self.items.extend(rest);
            self.items.extend(block);
            if goes_on(&self.items) {
                self.items.push(jump(to));
            }
            self.items.append(&mut tail);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::bbc::lines::Labels;

    /// A program with a way of so many lines between two labels, and what it is after
    /// that way is moved.
    fn moved(way: usize) -> String {
        let mut labels = Labels::default();
        let (from, to) = (labels.next(), labels.next());
        let mut lines = Lines::default();
        lines.line(format!("IF x THEN {to}"), None);
        lines.place(from);
        for n in 1..=way {
            lines.line(format!("a={n}"), None);
        }
        lines.place(to);
        lines.line("b=0", None);
        lines.line("END", None);
        lines.line("DEF PROCa", None);
        lines.away(&[(from, to)]).finish().0
    }

    #[test]
    fn a_way_stands_behind_the_end_and_jumps_back() {
        let expected = "10IF x THEN 30\n20GOTO 50\n30b=0\n40END\n\
            50a=1\n60a=2\n70a=3\n80a=4\n90GOTO 30\n100DEF PROCa\n";
        assert_eq!(moved(4), expected);
    }

    /// The line behind a way may have other names, and be come to by those alone.
    #[test]
    fn a_way_may_end_in_jumps_to_another_label() {
        let mut labels = Labels::default();
        let [from, to, other, top] = [(); 4].map(|()| labels.next());
        let mut lines = Lines::default();
        lines.place(top);
        lines.line("a=0", None);
        lines.place(from);
        lines.line(format!("IF x THEN {other}"), None);
        for n in 2..=4 {
            lines.line(format!("a={n}"), None);
        }
        lines.line(format!("GOTO {top}"), None);
        lines.place(other);
        lines.place(to);
        lines.line("b=0", None);
        lines.line("END", None);
        let expected = "10a=0\n20GOTO 50\n30b=0\n40END\n\
            50IF x THEN 30\n60a=2\n70a=3\n80a=4\n90GOTO 10\n";
        assert_eq!(lines.away(&[(from, to)]).finish().0, expected);
    }

    #[test]
    fn a_short_way_stays() {
        let expected = "10IF x THEN 30\n20a=1\n30b=0\n40END\n50DEF PROCa\n";
        assert_eq!(moved(1), expected);
    }
}
