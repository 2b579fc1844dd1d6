//! Source edits: a scene with some of its text replaced, read and checked anew.

use super::{Scene, used};
use slowlight_compiler::scene;
use slowlight_compiler::sema::Freeze;
use slowlight_compiler::source::{SourceFile, Span};
use slowlight_compiler::syntax;

/// A replacement in one of a scene's files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced; empty where something is put in.
    pub at: Span,
    /// What stands there then.
    pub text: String,
}

impl Edit {
    /// Where in the text before the edit something is that is at a place after it.
    fn before(&self, at: u32) -> u32 {
        let (start, end) = (self.at.start, self.at.end);
        let long = u32::try_from(self.text.len()).unwrap_or(u32::MAX);
        match at.checked_sub(start) {
            Some(behind) if behind >= long => end + (behind - long),
            Some(inside) => start + inside.min(end - start),
            None => at,
        }
    }

    /// The same for a span; what a place in the library is called from is not moved.
    pub fn told(&self, span: Span) -> Span {
        match span.file == self.at.file {
            true => Span {
                start: self.before(span.start),
                end: self.before(span.end),
                ..span
            },
            false => span,
        }
    }
}

impl Scene {
    /// The same scene from texts with edits, each in the text that those before it have left;
    /// none where it is wrong then.
    pub fn edited(&self, edits: &[Edit]) -> Option<Scene> {
        let mut files = self.checked.sources.files.clone();
        for edit in edits {
            let text = &mut files.get_mut(usize::from(edit.at.file))?.text;
            text.get(edit.at.range())?;
            text.replace_range(edit.at.range(), &edit.text);
        }
        let (library, own): (Vec<SourceFile>, Vec<SourceFile>) =
            files.into_iter().partition(|file| file.library);
        let library: Vec<(String, String)> =
            library.into_iter().map(|f| (f.name, f.text)).collect();
        let first = own.first()?;
        let mut read = |from: &str, path: &str| {
            let (name, text) = used(from, path)?;
            let known = own.iter().find(|file| file.name == name);
            Ok((name, known.map_or(text, |file| file.text.clone())))
        };
        let checked = scene::load(&first.name, &first.text, Some(&library), &mut read);
        checked.is_right().then(|| Scene {
            name: self.name.clone(),
            options: self.options.clone(),
            checked,
        })
    }

    /// The same scene from texts in which the item at a place does not stand; none where
    /// something needs it. Other items keep their places.
    pub fn without_item(&self, at: Span) -> Option<Scene> {
        let text = &self.checked.sources.files.get(usize::from(at.file))?.text;
        let items = syntax::parse(text, at.file).0.items;
        let item = (items.iter())
            .map(|item| item.span)
            .find(|span| span.range().contains(&(at.start as usize)))?;
        let blank = |c: char| {
            if c == '\n' {
                "\n".to_owned()
            } else {
                " ".repeat(c.len_utf8())
            }
        };
        let text = text.get(item.range())?.chars().map(blank).collect();
        self.edited(&[Edit { at: item, text }])
    }

    /// The same scene with all params folded like constants.
    #[must_use]
    pub fn frozen(&self) -> Scene {
        let mut frozen = self.clone();
        frozen.options.freeze = Freeze::All;
        frozen
    }

    /// The same scene with a param folded like a constant.
    pub fn freezing(&self, param: &str) -> Scene {
        let mut options = self.options.clone();
        options.freeze = match options.freeze {
            Freeze::All => Freeze::All,
            Freeze::Nothing => Freeze::Some(vec![param.to_owned()]),
            Freeze::Some(mut all) => {
                all.push(param.to_owned());
                Freeze::Some(all)
            }
        };
        Scene {
            name: self.name.clone(),
            checked: self.checked.clone(),
            options,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_told_as_they_were() {
        // `abcdef` with `XYZ` for `cd`.
        let edit = Edit {
            at: Span::new(0, 2, 4),
            text: "XYZ".to_owned(),
        };
        let told = |start, end| edit.told(Span::new(0, start, end)).range();
        assert_eq!(told(0, 2), 0..2);
        assert_eq!(told(5, 7), 4..6);
        assert_eq!(told(0, 7), 0..6);
        let other = Span::new(1, 5, 7);
        assert_eq!(edit.told(other), other);
    }
}
