//! Reading back a printed graph ([`super::print`] shows the form).
//!
//! What is read has no places in a scene; otherwise a printed graph reads back
//! to one that prints the same. Nodes that no output reaches are not printed,
//! so they come back as undefined.

use super::graph::*;
use crate::source::Span;
use slowlight_routine::{Op, Range, Type, Value};
use std::collections::BTreeMap;

/// A line that is not understood.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {what}")]
pub struct Unread {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong with it.
    pub what: String,
}

type Read<T> = Result<T, String>;

/// A graph from its text. At most a million nodes.
pub fn read(text: &str) -> Result<Graph, Unread> {
    let mut graph = Graph {
        image: Image {
            block: (1, 1),
            width: 1,
            height: 1,
            palette: Vec::new(),
        },
        params: Vec::new(),
        tables: Vec::new(),
        loops: Vec::new(),
        nodes: Vec::new(),
        types: Vec::new(),
        spans: Vec::new(),
        names: Default::default(),
        directions: BTreeMap::new(),
        ink: NodeId(0),
        shade: None,
        diffusion: None,
        refinement: None,
        effects: Vec::new(),
        reports: Vec::new(),
        claims: BTreeMap::new(),
        early: Default::default(),
        hoisted: Default::default(),
    };
    for (at, line) in text.lines().enumerate() {
        self::line(&mut graph, line.trim()).map_err(|what| Unread { line: at + 1, what })?;
    }
    Ok(graph)
}

fn line(graph: &mut Graph, line: &str) -> Read<()> {
    let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
    match word {
        "" => Ok(()),
        "image" => image(graph, rest),
        "param" => param(graph, rest),
        "table" => table(graph, rest),
        "loop" => self::loop_(graph, rest),
        "effect" => {
            let (name, calls) = rest
                .split_once(' ')
                .ok_or("an effect needs a name and a count")?;
            let calls = number(calls)?;
            graph.effects.push(EffectUse {
                name: name.to_owned(),
                calls,
            });
            Ok(())
        }
        "directions" => node_list(rest).map(|ids| {
            let unit = ids.into_iter().map(|id| (id, 1.0));
            graph.directions.extend(unit)
        }),
        "long" => {
            let (id, length) = rest
                .split_once(' ')
                .ok_or("a long direction needs a length")?;
            let length: f64 = number(length)?;
            graph.directions.insert(node_id(id)?, length);
            Ok(())
        }
        "shade" => node_id(rest).map(|id| graph.shade = Some(id)),
        "send" => share(rest).map(|share| {
            let none = || Diffusion {
                shares: Vec::new(),
                span: Span::default(),
            };
            let diffusion = graph.diffusion.get_or_insert_with(none);
            diffusion.shares.push(share);
        }),
        "keep" => {
            let words: Vec<&str> = rest.split(' ').collect();
            let [kept, "every", step, "within", tolerance, "often", often] = words[..] else {
                return Err("kept every n rows within so much, so often".to_owned());
            };
            graph.refinement = Some(Refinement {
                step: number(step)?,
                tolerance: number(tolerance)?,
                often: number(often)?,
                kept: node_id(kept)?,
            });
            Ok(())
        }
        "report" => node_id(rest).map(|id| graph.reports.push(id)),
        "ink" => node_id(rest).map(|id| graph.ink = id),
        _ => node(graph, line),
    }
}

fn number<T: std::str::FromStr>(text: &str) -> Read<T> {
    text.trim()
        .parse()
        .map_err(|_| format!("`{text}` is no number that fits here"))
}

fn node_id(text: &str) -> Read<NodeId> {
    let digits = text
        .trim()
        .strip_prefix('%')
        .ok_or_else(|| format!("`{text}` is no node"))?;
    number(digits).map(NodeId)
}

fn node_list(text: &str) -> Read<Vec<NodeId>> {
    text.split(',')
        .map(str::trim)
        .filter(|s| !s.is_empty())
        .map(node_id)
        .collect()
}

fn scalar(text: &str) -> Read<Type> {
    match text.trim() {
        "bool" => Ok(Type::Bool),
        "int" => Ok(Type::Int),
        "real" => Ok(Type::Real),
        other => Err(format!("`{other}` is no type")),
    }
}

fn value(ty: Type, text: &str) -> Read<Value> {
    match ty {
        Type::Bool => number(text).map(Value::Bool),
        Type::Int => number(text).map(Value::Int),
        Type::Real => number(text).map(Value::Real),
    }
}

/// The text between the first `(` of `text` and its `)`, and what follows.
fn parenthesised<'t>(text: &'t str, after: &str) -> Read<(&'t str, &'t str)> {
    let inner = text.split_once(after).map(|(_, rest)| rest);
    let inner = inner.ok_or_else(|| format!("`{after}` is missing"))?;
    inner
        .split_once(')')
        .ok_or_else(|| format!("no `)` behind `{after}`"))
}

fn share(text: &str) -> Read<Share> {
    match text.split_whitespace().collect::<Vec<_>>()[..] {
        [dx, dy, node] => Ok(Share {
            dx: number(dx)?,
            dy: number(dy)?,
            node: node_id(node)?,
        }),
        _ => Err("what is sent has two offsets and a node".to_owned()),
    }
}

fn image(graph: &mut Graph, text: &str) -> Read<()> {
    let mut words = text.split_whitespace();
    let size = words
        .next()
        .and_then(|s| s.split_once('x'))
        .ok_or("no size")?;
    (graph.image.width, graph.image.height) = (number(size.0)?, number(size.1)?);
    let mut words = words.peekable();
    if words.next_if_eq(&"of").is_some() {
        let block = words.next().and_then(|s| s.split_once('x'));
        let (wide, high) = block.ok_or("no block")?;
        graph.image.block = (number(wide)?, number(high)?);
    }
    for colour in words.skip(1) {
        let digits = colour.strip_prefix('#').ok_or("a colour is #rrggbb")?;
        let all = u32::from_str_radix(digits, 16).map_err(|_| "a colour is #rrggbb")?;
        graph
            .image
            .palette
            .push([(all >> 16) as u8, (all >> 8) as u8, all as u8]);
    }
    Ok(())
}

fn param(graph: &mut Graph, text: &str) -> Read<()> {
    let (head, rest) = text.split_once(" = ").ok_or("no value")?;
    let (label, ty) = head.split_once(": ").ok_or("no type")?;
    let label = label.split_once(' ').map_or(label, |(_, label)| label);
    let component = ["x", "y", "z"]
        .into_iter()
        .find(|c| label.ends_with(&format!("_{c}")));
    let name = component.map_or(label, |_| &label[..label.len() - 2]);
    let (rest, role) = match rest.split_once(" by ") {
        Some((rest, role)) => (rest, self::role(role)?),
        None => (rest, Role::Param),
    };
    let (value, range) = match rest.split_once(" in ") {
        Some((value, range)) => {
            let (lo, hi) = range.split_once("..").ok_or("no `..`")?;
            (value, Some(Range::new(number(lo)?, number(hi)?)))
        }
        None => (rest, None),
    };
    let value = number(value)?;
    graph.params.push(Param {
        name: name.to_owned(),
        component: component.unwrap_or(""),
        role,
        ty: scalar(ty)?,
        value,
        usual: value,
        range,
        span: Span::default(),
    });
    Ok(())
}

fn role(text: &str) -> Read<Role> {
    if text == "state" {
        return Ok(Role::State);
    }
    let found = Button::ALL.into_iter().find(|b| b.name() == text);
    found.map(Role::Input).ok_or("no such role".into())
}

fn table(graph: &mut Graph, text: &str) -> Read<()> {
    let (head, entries) = text.split_once(" =").ok_or("no entries")?;
    let (label, kind) = head.split_once(": ").ok_or("no type")?;
    let (ty, size) = kind.split_once(' ').ok_or("no size")?;
    let (width, height) = size.split_once('x').ok_or("no size")?;
    let ty = scalar(ty)?;
    let entries = entries
        .split_whitespace()
        .map(|e| value(ty, e).map(Constant::new));
    graph.tables.push(Table {
        name: label
            .split_once(' ')
            .map_or(label, |(_, name)| name)
            .to_owned(),
        width: number(width)?,
        height: number(height)?,
        ty,
        entries: entries.collect::<Read<_>>()?,
        seed: Vec::new(),
    });
    Ok(())
}

fn loop_(graph: &mut Graph, text: &str) -> Read<()> {
    let (carried, rest) = parenthesised(text, "(")?;
    let max = text.split_whitespace().nth(2).ok_or("no max")?;
    let again = rest.split_whitespace().nth(1).ok_or("no again")?;
    let (mut names, mut types, mut init) = (Vec::new(), Vec::new(), Vec::new());
    for one in carried.split(',').map(str::trim).filter(|s| !s.is_empty()) {
        let (name, rest) = one.split_once(": ").ok_or("no type")?;
        let (ty, start) = rest.split_once(" = ").ok_or("no start")?;
        names.push(name.to_owned());
        types.push(scalar(ty)?);
        init.push(node_id(start)?);
    }
    graph.loops.push(Loop {
        max: number(max)?,
        names,
        types,
        init,
        again: node_id(again)?,
        next: node_list(parenthesised(rest, "next (")?.0)?,
        done: node_list(parenthesised(rest, "done (")?.0)?,
        otherwise: node_list(parenthesised(rest, "else (")?.0)?,
        span: Span::default(),
    });
    Ok(())
}

fn node(graph: &mut Graph, line: &str) -> Read<()> {
    let (head, body) = line
        .split_once(" = ")
        .ok_or_else(|| format!("`{line}` is no line of a graph"))?;
    let (id, ty) = head.split_once(": ").ok_or("no type")?;
    let (id, ty) = (node_id(id)?, scalar(ty)?);
    let (body, name) = match body.split_once(" ; ") {
        Some((body, name)) => (body, Some(name)),
        None => (body, None),
    };
    let node = node_body(ty, body)?;
    let at = id.0 as usize;
    if at < graph.nodes.len() || at > 1_000_000 {
        return Err(format!("{id} does not follow the node before it"));
    }
    graph.nodes.resize(at, Node::Undefined(Type::Real));
    graph.types.resize(at, Type::Real);
    graph.nodes.push(node);
    graph.types.push(ty);
    graph.spans.resize(at + 1, Span::default());
    if let Some(name) = name.filter(|_| !matches!(node, Node::Param(_))) {
        graph.names.insert(id, name.into());
    }
    Ok(())
}

fn node_body(ty: Type, body: &str) -> Read<Node> {
    let (word, rest) = body.split_once(' ').unwrap_or((body, ""));
    let part = |text: &str| -> Read<(LoopId, u32)> {
        let (of, index) = text.split_once('.').ok_or("no index")?;
        Ok((LoopId(number(of)?), number(index)?))
    };
    Ok(match word {
        "const" => Node::Const(Constant::new(value(ty, rest)?)),
        "param" => Node::Param(ParamId(number(rest)?)),
        "axis" => Node::Axis(match rest.strip_prefix("x mod ") {
            Some(passes) => Axis::Pass(number(passes)?),
            None if rest == "x" => Axis::X,
            None if rest == "run" => Axis::Run,
            None => Axis::Y,
        }),
        "carried" => part(rest).map(|(of, index)| Node::Carried { of, index })?,
        "last" => part(rest).map(|(of, index)| Node::Last { of, index })?,
        "result" => part(rest).map(|(of, index)| Node::Result { of, index })?,
        "received" => Node::Received,
        "neighbour" => {
            let named = Neighbour::ALL.into_iter().find(|one| one.name() == rest);
            Node::Neighbour(named.ok_or("a neighbour is above, below or left")?)
        }
        "slot" => Node::Slot(ty),
        "undefined" => Node::Undefined(ty),
        "select" => match node_list(rest)?[..] {
            [cond, yes, no] => Node::Select { cond, yes, no },
            _ => return Err("a select has a condition and two arms".to_owned()),
        },
        "stepped" => match node_list(rest)?[..] {
            [first, step] => Node::Stepped { first, step },
            _ => return Err("what is stepped has a first value and a step".to_owned()),
        },
        "tabulated" => match node_list(rest)?[..] {
            [value] => Node::Tabulated(value),
            _ => return Err("what is tabulated is one value".to_owned()),
        },
        "ramp" => {
            let (rest, stride) = match rest.split_once(" every ") {
                Some((rest, stride)) => (rest, number(stride)?),
                None => (rest, 1),
            };
            match node_list(rest)?[..] {
                [first, step] => Node::Ramp {
                    first,
                    step,
                    stride,
                },
                _ => return Err("a ramp has a first value and a step".to_owned()),
            }
        }
        "lookup" => {
            let (table, indices) = rest.split_once('[').ok_or("no `[`")?;
            match node_list(indices.trim_end_matches(']'))?[..] {
                [column, row] => Node::Lookup {
                    table: TableId(number(table)?),
                    column,
                    row,
                },
                _ => return Err("a lookup has a column and a row".to_owned()),
            }
        }
        name => {
            let op = Op::named(name).ok_or_else(|| format!("no operation `{name}`"))?;
            let args = node_list(rest)?;
            match args[..] {
                [a] if op.arity() == 1 => Node::Apply(op, [a, a]),
                [a, b] if op.arity() == 2 => Node::Apply(op, [a, b]),
                _ => return Err(format!("{name} takes {} operands", op.arity())),
            }
        }
    })
}
