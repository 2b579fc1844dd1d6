//! Arrays by columns: filled before the first row, read in pixels.

use super::code::Code;
use super::expression::Expression;
use super::logs::known;
use super::{Line, Text};
use crate::ir::graph::*;
use crate::ir::tree::{Place, tabulated};

impl Code<'_> {
    /// Whether a value is an object.
    fn is_float(&self, id: NodeId) -> bool {
        self.plan.format(id).is_object()
    }

    /// Whether a value's sign has an array of its own.
    fn has_sign(&self, id: NodeId) -> bool {
        let range = self.plan.ranges.result.get(id.0 as usize);
        let real = self.plan.format(id) == self.plan.runtime.real;
        self.logs() && real && range.is_none_or(|range| known(*range).is_none())
    }

    /// The arrays that there are: names.
    pub fn columns(&self) -> Vec<String> {
        let all = tabulated(&self.plan.graph, &self.plan.tree);
        let names = all.into_iter().flat_map(|id| {
            let name = self.names.column(id).to_owned();
            let sign = self.has_sign(id).then(|| format!("{name}_plus"));
            [Some(name), sign].into_iter().flatten()
        });
        names.collect()
    }

    /// Makes and fills the arrays, by what a column computes.
    pub fn fill_columns(&mut self, column: Vec<Line>, picture: &mut Text) {
        let plan = self.plan;
        let found = tabulated(&plan.graph, &plan.tree);
        if found.is_empty() {
            return;
        }
        let length = plan.graph.image.width;
        for &id in &found {
            let name = self.names.column(id).to_owned();
            let about = if self.is_float(id) { OF_FLOATS } else { "" };
            picture.line(format!("let {name} = Array.new({length});{about}"));
            if self.has_sign(id) {
                picture.line(format!("let {name}_plus = Array.new({length});"));
            }
        }
        let x = self.names.axes[0].clone();
        let (first, last) = plan.computed_columns();
        picture.line(format!("let {x} = {first};"));
        picture.open(format!("while ({x} < {}) {{", last.saturating_add(1)));
        picture.append(column);
        picture.span = plan.drawn;
        picture.line(format!("let {x} = {x} + 1;"));
        picture.close("}");
    }

    /// Keeps a value that has just been set at its column.
    pub fn keep_column(&mut self, place: Place) {
        let Place::Node(id) = place else {
            return;
        };
        if !self.plan.is_tabulated(id) {
            return;
        }
        let home = self.names.home(place).to_owned();
        let (entry, sign) = self.column(id);
        self.line(format!("let {} = {home};", entry.text));
        if self.is_float(id) {
            // The entry is the home's object.
            self.line(format!("let {home} = Float.new();"));
        }
        if let Some(entry) = sign {
            let sign = self.sign_of(&home);
            self.line(format!("let {entry} = {sign};"));
        }
    }

    /// A value at the pixel's column; of a logarithm the sign, too.
    pub fn column(&self, id: NodeId) -> (Expression, Option<String>) {
        let (name, x) = (self.names.column(id), &self.names.axes[0]);
        let sign = self.has_sign(id).then(|| format!("{name}_plus[{x}]"));
        (Expression::term(format!("{name}[{x}]")), sign)
    }
}

/// Behind a line that makes an array of which each element is an object.
pub(super) const OF_FLOATS: &str = " // of Floats";
