//! What must be written out: the image, maps, the offsets of `spread`.

use super::Checker;
use super::call::count;
use crate::sema::colours::{COLOURS, colour};
use crate::sema::program::*;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree::{self, ExprKind as Tree, UnaryOp};

/// A side's greatest length, in pixels.
const SIDE: f64 = 4096.0;
/// The most inks of a palette.
const INKS: usize = 256;
/// The most cells of a map's side.
const CELLS: usize = 1024;

/// The integer that an expression writes out.
pub(super) fn whole(expr: &tree::Expr) -> Option<f64> {
    match &expr.kind {
        Tree::Int(value) => Some(*value),
        Tree::Unary(UnaryOp::Neg, of) => match of.kind {
            Tree::Int(value) => Some(-value),
            _ => None,
        },
        _ => None,
    }
}

impl Checker<'_> {
    pub(super) fn image(&mut self, image: &tree::Image, span: Span) {
        let mut side = |expr: &tree::Expr, what: &str| match whole(expr) {
            Some(n) if (1.0..=SIDE).contains(&n) => n as u32,
            _ => {
                if !matches!(expr.kind, Tree::Error) {
                    let message = format!("the image's {what} is a whole number from 1 to 4096");
                    self.error(expr.span, message);
                }
                1
            }
        };
        let width = side(&image.width, "width");
        let height = side(&image.height, "height");
        let mut palette = Vec::new();
        for ink in &image.inks {
            match colour(&ink.text) {
                Some(rgb) => palette.push(rgb),
                None => {
                    let error = format!("no colour `{}`", ink.text);
                    let mut error = Diagnostic::error(ink.span, error);
                    error.help = self
                        .among(&ink.text, COLOURS.iter().map(|c| c.0))
                        .or_else(|| {
                            let names: Vec<&str> = COLOURS.iter().map(|c| c.0).collect();
                            Some(format!(
                                "use `#rrggbb`, `#rgb`, or one of: {}",
                                names.join(", ")
                            ))
                        });
                    self.report(error);
                    palette.push([0, 0, 0]);
                }
            }
        }
        if !(2..=INKS).contains(&image.inks.len()) {
            let message = format!("a picture has 2 to {INKS} inks, not {}", image.inks.len());
            self.error(span, message);
        }
        palette.truncate(INKS);
        self.program.image = Some(Image {
            width,
            height,
            palette,
            span,
        });
    }

    pub(super) fn map(
        &mut self,
        id: MapId,
        rows: &[(String, Span)],
        cells: &[(char, tree::Expr)],
        span: Span,
    ) {
        let mut meanings: Vec<(char, i32)> = Vec::new();
        for (symbol, value) in cells {
            if meanings.iter().any(|(s, _)| s == symbol) {
                self.error(value.span, format!("'{symbol}' has two meanings"));
            }
            match whole(value) {
                Some(n) if (-32768.0..=32767.0).contains(&n) => meanings.push((*symbol, n as i32)),
                _ => {
                    if !matches!(value.kind, Tree::Error) {
                        let message = "a map's cell is a whole number from -32768 to 32767";
                        self.error(value.span, message);
                    }
                    meanings.push((*symbol, 0));
                }
            }
        }
        let width = rows.first().map_or(0, |(r, _)| r.chars().count());
        if rows.is_empty() || width == 0 {
            self.error(span, "a map has at least one cell");
            return;
        }
        if width > CELLS || rows.len() > CELLS {
            self.error(span, format!("a map has at most {CELLS} cells a side"));
            return;
        }
        let mut grid = Vec::new();
        let mut unknown = Vec::new();
        for (row, span) in rows {
            let length = row.chars().count();
            if length != width {
                let message = format!(
                    "this row has {}, the first has {width}",
                    count(length, "cell")
                );
                let error = Diagnostic::error(*span, message);
                self.report(error.also(rows[0].1, "the first row"));
                return;
            }
            for symbol in row.chars() {
                let found = meanings.iter().find(|(s, _)| *s == symbol);
                if found.is_none() && !unknown.contains(&symbol) {
                    unknown.push(symbol);
                    let error = Diagnostic::error(*span, format!("'{symbol}' has no meaning"));
                    self.report(error.help(format!("add `'{symbol}' => 0` to the map's `where`")));
                }
                grid.push(found.map_or(0, |(_, n)| *n));
            }
        }
        let map = &mut self.program.maps[id.0];
        (map.width, map.height, map.cells) = (width, rows.len(), grid);
    }
}
