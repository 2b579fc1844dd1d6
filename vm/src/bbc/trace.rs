//! TRACE: the number of each line that is begun, in brackets.

use super::ast::Stmt;
use super::program::Program;
use super::state::State;

impl State {
    /// Tells the line that begins at an op, if one does and TRACE is to tell it. A loop that NEXT
    /// turns back to the start of a line does not begin it.
    pub(super) fn tell_line(&mut self, p: &Program, at: u32) {
        let Some(op) = p.ops.get(at as usize) else {
            return;
        };
        let Some(line) = p.lines.get(op.line as usize).filter(|l| l.op == at) else {
            return;
        };
        let before = p.ops.get(self.op as usize).map(|op| &op.stmt);
        let turned = matches!(before, Some(Stmt::Next(_))) && at != self.op + 1;
        if line.number < self.trace && !turned {
            self.write(format!("[{}] ", line.number).as_bytes());
        }
    }
}
