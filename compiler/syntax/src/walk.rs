//! Visits the parts of a tree, so that each analysis says only what it looks for.

use super::tree::{
    Counter, Expr, ExprKind, Facet, File, Function, Image, ItemKind, Member, Statement,
};

/// Calls `visit` with each expression directly inside `expr`, left to right.
pub fn children<'t>(expr: &'t Expr, visit: &mut dyn FnMut(&'t Expr)) {
    match &expr.kind {
        ExprKind::Error
        | ExprKind::Int(_)
        | ExprKind::Real(_)
        | ExprKind::Angle(..)
        | ExprKind::Bool(_)
        | ExprKind::None
        | ExprKind::Name(_) => {}
        ExprKind::Tuple(parts) | ExprKind::Next(parts) => parts.iter().for_each(visit),
        ExprKind::Table(rows) => rows.iter().flatten().for_each(visit),
        ExprKind::Unary(_, a) => visit(a),
        ExprKind::Binary(_, a, b) => {
            visit(a);
            visit(b);
        }
        ExprKind::Call { args, .. } => args.iter().for_each(|a| visit(&a.value)),
        ExprKind::Method { receiver, args, .. } => {
            visit(receiver);
            args.iter().for_each(|a| visit(&a.value));
        }
        ExprKind::Field { base, .. } => visit(base),
        ExprKind::Index { base, indices } => {
            visit(base);
            indices.iter().for_each(visit);
        }
        ExprKind::If {
            condition, yes, no, ..
        } => {
            visit(condition);
            visit(yes);
            visit(no);
        }
        ExprKind::Loop {
            carried,
            max,
            body,
            otherwise,
        } => {
            carried.iter().for_each(|(_, start)| visit(start));
            visit(max);
            visit(body);
            visit(otherwise);
        }
        ExprKind::Each(each) => {
            each.args.iter().for_each(|a| visit(&a.value));
            counter_roots(&each.counter, visit);
            visit(&each.body);
        }
        ExprKind::Block { statements, result } => {
            for statement in statements {
                match statement {
                    Statement::Let { value, .. } => visit(value),
                    Statement::Spread { value, to, .. } => {
                        visit(value);
                        for (offset, weight) in to {
                            visit(offset);
                            visit(weight);
                        }
                    }
                }
            }
            visit(result);
        }
    }
}

/// Calls `visit` with the outermost expressions of a file, in order.
pub fn roots<'t>(file: &'t File, visit: &mut dyn FnMut(&'t Expr)) {
    for item in &file.items {
        item_roots(&item.kind, visit);
    }
}

/// Calls `visit` with the outermost expressions of an item, in order.
pub fn item_roots<'t>(item: &'t ItemKind, visit: &mut dyn FnMut(&'t Expr)) {
    match item {
        ItemKind::Image(Image { width, height, .. }) => {
            visit(width);
            visit(height);
        }
        ItemKind::Param(param) => {
            visit(&param.value);
            if let Some((low, high)) = &param.range {
                visit(low);
                visit(high);
            }
            param.next.iter().for_each(|next| visit(next));
        }
        ItemKind::Const { value, .. } => visit(value),
        ItemKind::Fn(function) | ItemKind::Dither(function) => {
            function_roots(function, None, visit);
        }
        ItemKind::Effect {
            function,
            otherwise,
        } => {
            function_roots(function, Some(otherwise), visit);
        }
        ItemKind::Shape { params, facets, .. } => {
            params
                .iter()
                .filter_map(|p| p.default.as_ref())
                .for_each(&mut *visit);
            facets.iter().for_each(|Facet { body, .. }| visit(body));
        }
        ItemKind::Scene { members, .. } => member_roots(members, visit),
        ItemKind::Record { .. } | ItemKind::Use { .. } => {}
        ItemKind::Map { cells, .. } => cells.iter().for_each(|(_, value)| visit(value)),
        ItemKind::Draw { body, .. } => visit(body),
    }
}

// Recursion is bounded: members nest no deeper than `cut::MAX_DEPTH`.
fn member_roots<'t>(members: &'t [Member], visit: &mut dyn FnMut(&'t Expr)) {
    for member in members {
        match member {
            Member::One { shape, tag } => {
                visit(shape);
                tag.iter().for_each(&mut *visit);
            }
            Member::Each { counter, members } => {
                counter_roots(counter, visit);
                member_roots(members, visit);
            }
        }
    }
}

fn counter_roots<'t>(counter: &'t Counter, visit: &mut dyn FnMut(&'t Expr)) {
    visit(&counter.low);
    visit(&counter.high);
}

fn function_roots<'t>(
    function: &'t Function,
    otherwise: Option<&'t Expr>,
    visit: &mut dyn FnMut(&'t Expr),
) {
    function
        .params
        .iter()
        .filter_map(|p| p.default.as_ref())
        .for_each(&mut *visit);
    otherwise.into_iter().for_each(&mut *visit);
    visit(&function.body);
}
