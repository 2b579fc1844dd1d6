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
        // Picture after picture in the same arrays.
        if !plan.graph.is_moving() {
            self.make_columns(picture);
        }
        self.along_columns(column, picture);
    }

    /// Makes the arrays.
    fn make_columns(&self, text: &mut Text) {
        let plan = self.plan;
        let length = plan.graph.image.width;
        for id in tabulated(&plan.graph, &plan.tree) {
            let name = self.names.column(id);
            let about = if self.is_float(id) { OF_FLOATS } else { "" };
            text.line(format!("let {name} = Array.new({length});{about}"));
            if self.has_sign(id) {
                text.line(format!("let {name}_plus = Array.new({length});"));
            }
        }
    }

    /// The same for pictures that move, with objects in those that are of objects.
    pub fn make_columns_once(&self) -> Vec<Line> {
        let mut text = Text::default();
        self.make_columns(&mut text);
        let found = tabulated(&self.plan.graph, &self.plan.tree);
        let objects = found.into_iter().filter(|id| self.is_float(*id));
        let new = |id| format!("let {} = Float.new();", self.column(id).0.text);
        let mut lines = Text::default();
        objects.for_each(|id| lines.line(new(id)));
        if !lines.lines.is_empty() {
            self.along_columns(lines.lines, &mut text);
        }
        text.lines
    }

    /// A loop over the columns.
    fn along_columns(&self, column: Vec<Line>, text: &mut Text) {
        let x = self.names.axes[0].clone();
        let (first, last) = self.plan.computed_columns();
        text.line(format!("let {x} = {first};"));
        text.open(format!("while ({x} < {}) {{", last.saturating_add(1)));
        text.append(column);
        text.span = self.plan.drawn;
        text.line(format!("let {x} = {x} + 1;"));
        text.close("}");
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
        let entry = entry.text;
        match (self.is_float(id), self.plan.graph.is_moving()) {
            (false, _) => self.line(format!("let {entry} = {home};")),
            // The entry is the home's object.
            (true, false) => {
                self.line(format!("let {entry} = {home};"));
                self.line(format!("let {home} = Float.new();"));
            }
            // They change places: nothing is made while pictures move.
            (true, true) => {
                let spare = self.spare();
                self.line(format!("let {spare} = {entry};"));
                self.line(format!("let {entry} = {home};"));
                self.line(format!("let {home} = {spare};"));
            }
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
