//! INPUT: prompts, the line that is typed, and the items in it.
//!
//! As on the ROM, a line's items go to one variable after the other; a prompt drops the rest, a
//! variable for which nothing is left asks for a new line, with a question mark unless a prompt
//! stands right before it. Numbers are what VAL makes of their items.

use super::ast::{Ask, Place};
use super::code::Code;
use super::data::{after_comma, string_item};
use super::error::Error;
use super::io::Layout;
use super::state::State;
use super::strings::val;
use super::values::{Value, is_numeric};

type Result<T> = std::result::Result<T, Error>;

impl State {
    /// INPUT, or INPUT LINE, which takes `whole` lines.
    pub(super) fn input(&mut self, p: &Code<'_>, asks: &[Ask], whole: bool) -> Result<()> {
        let mut mark = true;
        let mut rest = None;
        for ask in asks {
            match ask {
                Ask::Print(item) => {
                    self.print_item(p, item, &mut Layout::default())?;
                    mark = false;
                    rest = None;
                }
                Ask::Separator => mark = true,
                Ask::Read(place) => {
                    let home = self.home(p, place)?;
                    let line = match rest.take() {
                        Some(line) => line,
                        None => {
                            if mark {
                                self.write(b"?");
                            }
                            self.line_typed()?
                        }
                    };
                    mark = true;
                    let item = if whole {
                        line
                    } else {
                        let (item, used) = string_item(&line)?;
                        rest = after_comma(&line, used)
                            .and_then(|at| line.get(at..))
                            .map(<[u8]>::to_vec);
                        item
                    };
                    self.store(home, typed_value(place, item)?)?;
                }
            }
        }
        Ok(())
    }

    /// The next line that is typed, as it also comes to be seen.
    fn line_typed(&mut self) -> Result<Vec<u8>> {
        if self.keyboard.is_some() {
            return self.read_line();
        }
        let line = self.typed.pop_front().unwrap_or_default();
        for c in &line {
            // Letters alone change nothing that could be wrong.
            let _ = self.vdu((*c).max(b' '));
        }
        self.new_line();
        Ok(line)
    }
}

fn typed_value(place: &Place, item: Vec<u8>) -> Result<Value> {
    Ok(if is_numeric(place) {
        Value::Num(val(&item)?)
    } else {
        Value::Str(item)
    })
}
