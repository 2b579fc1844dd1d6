//! PRINT, files, VDU and drawing statements, star commands; `input` has INPUT.

use slowlight_isa::real40::Real40;
use slowlight_isa::real40::text::NumberFormat;

use super::Dialect;
use super::ast::{Expr, Item, Stmt};
use super::code::Code;
use super::cost::plot;
use super::error::Error;
use super::state::State;
use super::strings::number_text;
use super::values::{Num, Value};
use super::work;

type Result<T> = std::result::Result<T, Error>;

/// Captured text beyond this is dropped.
const MOST_TEXT: usize = 1 << 20;

/// How PRINT writes numbers, up to the next `,` or `;`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Layout {
    /// After `;`: not at the end of a field.
    close: bool,
    /// After `~`.
    hex: bool,
}

impl State {
    pub fn exec_io(&mut self, p: &Code<'_>, stmt: &Stmt) -> Result<()> {
        match stmt {
            Stmt::Print(items) => self.print(p, items)?,
            Stmt::Input(asks, whole) => self.input(p, asks, *whole)?,
            Stmt::Mode(e) => {
                let mode = self.int(p, e)? as u8;
                self.set_mode(mode)?;
            }
            Stmt::Vdu(items) => {
                for (e, word) in items {
                    let n = self.int(p, e)?;
                    self.vdu(n as u8)?;
                    if *word {
                        self.vdu((n >> 8) as u8)?;
                    }
                }
            }
            Stmt::Gcol(ab) => {
                let action = self.int(p, &ab.0)?;
                let ink = self.int(p, &ab.1)?;
                self.charge(plot::GCOL);
                self.display.gcol(action as u8, ink as u8);
            }
            Stmt::Colour(e) => {
                let ink = self.int(p, e)?;
                self.vdu(17)?;
                self.vdu(ink as u8)?;
            }
            Stmt::Plot(kxy) => {
                let k = self.int(p, &kxy.0)?;
                let x = self.int(p, &kxy.1)?;
                let y = self.int(p, &kxy.2)?;
                self.plot(k as u8, x, y);
            }
            Stmt::PlotAs(k, xy) => {
                let x = self.int(p, &xy.0)?;
                let y = self.int(p, &xy.1)?;
                self.plot(*k, x, y);
            }
            Stmt::Cls => self.vdu(12)?,
            Stmt::Clg => self.vdu(16)?,
            Stmt::Report => {
                let (_, message) = self.last_error();
                self.new_line();
                self.write(message.as_bytes());
            }
            Stmt::Width(e) => self.width = u32::from(self.int(p, e)? as u8),
            Stmt::OsCli(e) => {
                let command = self.string(p, e)?;
                self.star(&command)?;
            }
            other => self.exec_file(p, other)?,
        }
        Ok(())
    }

    fn exec_file(&mut self, p: &Code<'_>, stmt: &Stmt) -> Result<()> {
        match stmt {
            Stmt::Bput(ab) => {
                let channel = self.int(p, &ab.0)?;
                let byte = self.int(p, &ab.1)? as u8;
                self.files.put(channel, byte)
            }
            Stmt::Close(e) => {
                let channel = self.int(p, e)?;
                self.files.close(channel)
            }
            Stmt::SetPtr(ab) => {
                let channel = self.int(p, &ab.0)?;
                let at = self.int(p, &ab.1)?;
                self.files.seek(channel, at)
            }
            Stmt::PrintFile(channel, list) => {
                let channel = self.int(p, channel)?;
                for e in list {
                    let value = self.value(p, e)?;
                    self.write_record(channel, &value)?;
                }
                Ok(())
            }
            Stmt::InputFile(channel, places) => {
                let channel = self.int(p, channel)?;
                for place in places {
                    let home = self.home(p, place)?;
                    let value = self.read_record(channel)?;
                    self.store(home, value)?;
                }
                Ok(())
            }
            _ => Err(Error::Syntax),
        }
    }

    /// PRINT#: a type byte, then the value last byte first (&40 integer, &FF real, 0 string).
    fn write_record(&mut self, channel: i32, value: &Value) -> Result<()> {
        let mut bytes = Vec::new();
        match value {
            Value::Num(Num::Int(n)) => {
                bytes.push(0x40);
                bytes.extend(n.to_be_bytes());
            }
            Value::Num(Num::Real(x)) => {
                bytes.push(0xff);
                bytes.extend(x.to_bytes().iter().rev());
            }
            Value::Str(s) => {
                bytes.extend([0, s.len() as u8]);
                bytes.extend(s.iter().rev());
            }
        }
        bytes.iter().try_for_each(|b| self.files.put(channel, *b))
    }

    fn read_record(&mut self, channel: i32) -> Result<Value> {
        let kind = self.files.get(channel)?;
        let length = match kind {
            0x40 => 4,
            0xff => 5,
            0 => usize::from(self.files.get(channel)?),
            _ => return Err(Error::TypeMismatch),
        };
        let mut bytes = Vec::with_capacity(length);
        for _ in 0..length {
            bytes.push(self.files.get(channel)?);
        }
        bytes.reverse();
        Ok(match (kind, bytes.as_slice()) {
            (0x40, &[a, b, c, d]) => Value::Num(Num::Int(i32::from_le_bytes([a, b, c, d]))),
            (0xff, &[a, b, c, d, e]) => Value::Num(Num::Real(Real40::from_bytes([a, b, c, d, e]))),
            _ => Value::Str(bytes),
        })
    }

    fn print(&mut self, p: &Code<'_>, items: &[Item]) -> Result<()> {
        let mut layout = Layout::default();
        for item in items {
            self.print_item(p, item, &mut layout)?;
        }
        if !matches!(items.last(), Some(Item::Semicolon)) {
            self.new_line();
        }
        Ok(())
    }

    /// One item of PRINT or INPUT.
    pub(super) fn print_item(
        &mut self,
        p: &Code<'_>,
        item: &Item,
        layout: &mut Layout,
    ) -> Result<()> {
        match item {
            Item::Value(e) => self.print_value(p, e, *layout)?,
            Item::Hex => layout.hex = true,
            Item::Comma => {
                *layout = Layout::default();
                let field = self.at_percent() as u32 & 255;
                let over = self.count.checked_rem(field).unwrap_or(0);
                if over > 0 {
                    self.spaces(field - over);
                }
            }
            Item::Semicolon => {
                *layout = Layout {
                    close: true,
                    hex: false,
                }
            }
            Item::NewLine => self.new_line(),
            Item::Tab(e) => {
                // A column is a byte.
                let x = u32::from(self.int(p, e)? as u8);
                if self.count > x {
                    self.new_line();
                }
                self.spaces(x - self.count);
            }
            Item::TabXy(x, y) => {
                let x = self.int(p, x)? as u8;
                let y = self.int(p, y)? as u8;
                for b in [31, x, y] {
                    self.vdu(b)?;
                }
            }
            Item::Spc(e) => {
                let n = self.int(p, e)? as u8;
                self.spaces(u32::from(n));
            }
        }
        Ok(())
    }

    fn spaces(&mut self, n: u32) {
        for _ in 0..n {
            self.write(b" ");
        }
    }

    fn print_value(&mut self, p: &Code<'_>, e: &Expr, layout: Layout) -> Result<()> {
        let format = NumberFormat::from_at_percent(self.at_percent());
        let text = match self.value(p, e)? {
            Value::Str(s) => {
                self.write(&s);
                return Ok(());
            }
            Value::Num(n) if layout.hex => format!("{:X}", n.int()?),
            Value::Num(n) => {
                let x = self.real_of(n);
                self.cycles += u64::from(work::number_text(x));
                number_text(n, format)
            }
        };
        if !layout.close {
            for _ in text.len()..usize::from(format.width) {
                self.write(b" ");
            }
        }
        self.write(text.as_bytes());
        Ok(())
    }

    /// Characters to the screen and the captured text. Control characters go through VDU.
    pub fn write(&mut self, text: &[u8]) {
        for c in text {
            if *c != 13 && self.width > 0 && self.count >= self.width {
                self.new_line();
            }
            // The queue of a VDU command cannot fail on what PRINT sends, but for a bad mode.
            let _ = self.vdu(*c);
            self.cycles += work::CHARACTER;
            self.count = if *c == 13 { 0 } else { self.count + 1 };
        }
    }

    pub fn new_line(&mut self) {
        self.cycles += work::NEW_LINE;
        let _ = self.vdu(13);
        let _ = self.vdu(10);
        self.count = 0;
    }

    /// One byte to the VDU drivers.
    pub fn vdu(&mut self, byte: u8) -> Result<()> {
        self.cycles += plot::VDU_BYTE;
        let waiting = self.display.is_waiting();
        if !waiting && (byte >= 32 || byte == 10) && self.text.len() < MOST_TEXT && byte != 127 {
            self.text.push(byte);
        }
        let Some(command) = self.display.take(byte) else {
            return Ok(());
        };
        match command.as_slice() {
            [22, mode] => self.set_mode(*mode)?,
            [25, k, xl, xh, yl, yh] => {
                let x = i16::from_le_bytes([*xl, *xh]);
                let y = i16::from_le_bytes([*yl, *yh]);
                self.plot(*k, i32::from(x), i32::from(y));
            }
            command => {
                if matches!(command, [12 | 16]) {
                    self.charge(plot::CLEAR_BYTE * u64::from(0x8000u32.saturating_sub(self.himem)));
                }
                self.display.command(&mut self.mem, command);
            }
        }
        Ok(())
    }

    fn charge(&mut self, cycles: u64) {
        self.cycles += cycles;
        self.plot_cycles += cycles;
    }

    fn plot(&mut self, k: u8, x: i32, y: i32) {
        let cycles = self.display.plot(&mut self.mem, k, x, y);
        self.charge(cycles);
    }

    /// MODE: moves HIMEM, if the program and its variables leave room and nothing is on the stack.
    fn set_mode(&mut self, mode: u8) -> Result<()> {
        // OS 1.20 looks at three bits.
        let mode = match self.config.dialect {
            Dialect::Micro => mode & 7,
            _ => mode,
        };
        let himem = self.display.himem_of(mode).ok_or(Error::BadMode)?;
        if himem < self.heap || !self.frames.is_empty() {
            return Err(Error::BadMode);
        }
        self.display.set_mode(&mut self.mem, mode);
        self.cycles += plot::CLEAR_BYTE * u64::from(0x8000u32.saturating_sub(self.himem));
        self.himem = himem;
        self.stack = himem;
        self.least_free = self.least_free.min(himem - self.heap);
        self.count = 0;
        Ok(())
    }

    /// A star command. Those that only set the machine up are accepted and do nothing.
    fn star(&mut self, command: &[u8]) -> Result<()> {
        let text: String = command.iter().map(|c| char::from(*c)).collect();
        let word = text.trim_start_matches([' ', '*']).to_ascii_uppercase();
        let known = [
            "FX", "TV", "|", "HELP", "DISC", "DISK", "DIR", "DRIVE", "SPOOL", "ENABLE", "MOTOR",
            "KEY", "OPT",
        ];
        let number = |rest: &str| rest.trim_start().starts_with(|c: char| c.is_ascii_digit());
        if word.strip_prefix("FX").is_some_and(|rest| !number(rest)) {
            return Err(Error::BadCommand);
        }
        if word.is_empty() || known.iter().any(|k| word.starts_with(k)) {
            Ok(())
        } else {
            Err(Error::BadCommand)
        }
    }
}
