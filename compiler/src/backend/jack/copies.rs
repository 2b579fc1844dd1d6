//! Copies of values into places.

use super::code::Code;
use super::expression::Expression;
use crate::ir::tree::*;
use slowlight_routine::Format;

impl Code<'_> {
    /// Gives a place a value.
    pub(super) fn set(&mut self, place: Place, from: Origin) {
        let format = self.plan.place_format(place);
        let from_id = match from {
            Origin::Node(id) => Some(id),
            Origin::Scratch(..) => None,
        };
        let from = match from {
            Origin::Node(id) => self.read(id),
            Origin::Scratch(l, k) => Expression::term(self.names.home(Place::Scratch(l, k))),
        };
        let home = self.home(place, format);
        if let Format::Log { .. } = format {
            return self.set_log((place, &home), (from_id, &from.text));
        }
        if let (Some(points), Some(id), Format::Fixed { frac, .. }) =
            (self.points(), from_id, format)
        {
            let from = self.read_at(points, id, frac).text;
            if from != home {
                self.line(format!("let {home} = {from};"));
            }
            return;
        }
        if from.text == home {
            return;
        }
        if format.is_object() {
            self.needs.insert("Float.copy");
            self.line(format!("do {home}.copy({});", from.text));
        } else {
            self.line(format!("let {home} = {};", from.text));
        }
    }
}
