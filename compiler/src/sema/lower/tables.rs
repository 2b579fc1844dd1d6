//! Tables and maps: known entries, looked up by values that may not be known.

use super::value::{Table, Val};
use super::{Found, Lower};
use crate::ir::graph;
use crate::ir::graph::{Constant, NodeId, TableId};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::{Type, Value};
use std::rc::Rc;

/// The most rows of a Bayer matrix, whose steps are then 1/65536 of the range.
const BAYER: i32 = 256;

/// Tables that were made already: a scene may look into a large one often.
#[derive(Default)]
pub(super) struct Made {
    maps: FxHashMap<MapId, TableId>,
    /// By address; the table is kept, so that no other gets its address.
    columns: FxHashMap<*const Table, (Rc<Table>, Rc<[TableId]>)>,
    bayer: FxHashMap<i32, Rc<Table>>,
    pub nearest: FxHashMap<i32, Rc<Table>>,
}

impl<'a> Lower<'a> {
    pub(super) fn index(&mut self, base: &'a Expr, indices: &'a [Expr], span: Span) -> Found<Val> {
        let value = self.expr(base)?;
        let mut nodes = Vec::new();
        for index in indices {
            let value = self.expr(index)?;
            nodes.push(self.node(value, &Ty::Int, span)?);
        }
        let Some(&column) = nodes.first() else {
            return Err(self.confused(span));
        };
        let row = match nodes.get(1) {
            Some(&row) => row,
            None => self.int(0, span),
        };
        match self.force(value)? {
            Val::Table(table) => {
                if nodes.len() == 1 && table.height() > 1 {
                    let error = self.error(span, "this table has several rows");
                    return Err(Box::new(error.help("index it by `[column, row]`")));
                }
                let Ty::Table(of) = &base.ty else {
                    return Err(self.confused(span));
                };
                self.entry(&table, of, column, row, span)
            }
            Val::Map(id) => {
                let table = self.cells(id, span)?;
                let span = self.at(span);
                Ok(Val::Node(self.b.lookup(table, column, row, span)))
            }
            Val::Undefined => Ok(Val::Undefined),
            _ => Err(self.confused(span)),
        }
    }

    /// A map as the graph has it, made once.
    fn cells(&mut self, id: MapId, span: Span) -> Found<TableId> {
        if let Some(&found) = self.tables.maps.get(&id) {
            return Ok(found);
        }
        let Some(map) = self.program.maps.get(id.0) else {
            return Err(self.confused(span));
        };
        let entries = map.cells.iter();
        let found = self.b.table(graph::Table {
            name: map.name.clone(),
            width: map.width as u32,
            height: map.height as u32,
            ty: Type::Int,
            entries: entries.map(|&c| Constant::new(Value::Int(c))).collect(),
            seed: Vec::new(),
        });
        self.tables.maps.insert(id, found);
        Ok(found)
    }

    /// An entry; both indices clamp.
    fn entry(
        &mut self,
        table: &Rc<Table>,
        of: &Ty,
        column: NodeId,
        row: NodeId,
        span: Span,
    ) -> Found<Val> {
        let clamp = |i: i32, n: usize| (i.max(0) as usize).min(n.saturating_sub(1));
        if let (Some(c), Some(r)) = (self.b.value(column), self.b.value(row)) {
            let at = clamp(r.int(), table.height()) * table.width + clamp(c.int(), table.width);
            return match table.entries.get(at) {
                Some(entry) => self.force(entry.clone()),
                None => Err(self.confused(span)),
            };
        }
        let layout = self.layout(of, &table.name, span)?;
        if !of.is_data() || layout.is_empty() {
            let error = self.error(span, "which entry this is must be known when compiling");
            return Err(Box::new(error));
        }
        let tables = self.columns(table, of, layout, span)?;
        let span = self.at(span);
        let found: Vec<NodeId> = tables
            .iter()
            .map(|&id| self.b.lookup(id, column, row, span))
            .collect();
        Ok(self.unflatten(of, &mut found.into_iter()))
    }

    /// A table as the graph has it, one for each scalar of an entry, made once.
    fn columns(
        &mut self,
        table: &Rc<Table>,
        of: &Ty,
        layout: Vec<(String, Type)>,
        span: Span,
    ) -> Found<Rc<[TableId]>> {
        if let Some((_, found)) = self.tables.columns.get(&Rc::as_ptr(table)) {
            return Ok(found.clone());
        }
        let mut columns: Vec<Vec<Constant>> = vec![Vec::new(); layout.len()];
        for entry in &table.entries {
            self.step(span)?;
            let mut nodes = Vec::new();
            self.flatten(entry.clone(), of, &mut nodes, span)?;
            for (column, node) in columns.iter_mut().zip(nodes) {
                let Some(value) = self.b.value(node) else {
                    let error = self.error(span, "this table's entries are not constant");
                    return Err(Box::new(error.help(
                        "choose by `if`, or index it by what is known when compiling",
                    )));
                };
                column.push(Constant::new(value));
            }
        }
        let found: Rc<[TableId]> = layout
            .into_iter()
            .zip(columns)
            .map(|((name, ty), entries)| {
                self.b.table(graph::Table {
                    name,
                    width: table.width as u32,
                    height: table.height() as u32,
                    ty,
                    entries,
                    seed: Vec::new(),
                })
            })
            .collect();
        let kept = (table.clone(), found.clone());
        self.tables.columns.insert(Rc::as_ptr(table), kept);
        Ok(found)
    }

    /// The n x n ordered-dither matrix over n^2 (Bayer 1973): each entry of the
    /// half-sized matrix four times over, plus its quadrant's rank. The first
    /// row of the 2 x 2 matrix is 0, 3, the second 2, 1.
    pub(super) fn bayer(&mut self, n: &'a Expr, span: Span) -> Found<Val> {
        let side = self.known_int(n, "the size of a Bayer matrix")?;
        if !(1..=BAYER).contains(&side) || side.count_ones() != 1 {
            let message = format!("no Bayer matrix has {side} rows");
            let error = self.error(n.span, message);
            return Err(Box::new(
                error.help(format!("its size is a power of two, at most {BAYER}")),
            ));
        }
        if let Some(found) = self.tables.bayer.get(&side) {
            return Ok(Val::Table(found.clone()));
        }
        let rank = |x: i32, y: i32| match (x & 1, y & 1) {
            (0, 0) => 0,
            (1, 0) => 3,
            (0, _) => 2,
            _ => 1,
        };
        let mut entries = Vec::new();
        for y in 0..side {
            for x in 0..side {
                let mut value = 0;
                let mut bit = side / 2;
                let mut weight = 1;
                while bit > 0 {
                    value += weight * rank(x / bit, y / bit);
                    weight *= 4;
                    bit /= 2;
                }
                let node = self.real(f64::from(value) / f64::from(side * side), span);
                entries.push(Val::Node(node));
            }
        }
        let table = Rc::new(Table {
            name: format!("bayer{side}"),
            width: side as usize,
            entries,
        });
        self.tables.bayer.insert(side, table.clone());
        Ok(Val::Table(table))
    }
}
