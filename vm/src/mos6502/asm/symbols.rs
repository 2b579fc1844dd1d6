//! Names and their values.

use std::collections::{BTreeMap, VecDeque};

use super::expr::{Expr, NoValue};

/// A name, where it was met and what it stands for.
#[derive(Clone, Debug)]
pub(super) struct Symbol {
    pub name: String,
    pub value: Option<i64>,
    /// Line and column of the definition, if there is one.
    pub defined: Option<(u32, u32)>,
    /// Line and column of the first use.
    pub used: (u32, u32),
}

#[derive(Clone, Debug, Default)]
pub(super) struct Symbols {
    all: Vec<Symbol>,
    by_name: BTreeMap<String, usize>,
}

impl Symbols {
    /// The symbol of this name, new if need be.
    pub fn mention(&mut self, name: &str, line: u32, column: u32) -> usize {
        if let Some(known) = self.by_name.get(name) {
            return *known;
        }
        let index = self.all.len();
        self.all.push(Symbol {
            name: name.to_owned(),
            value: None,
            defined: None,
            used: (line, column),
        });
        self.by_name.insert(name.to_owned(), index);
        index
    }

    /// The symbol of this name, if there is one.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    /// Says that a symbol is defined here; the line of the first definition where it already was.
    pub fn define(&mut self, symbol: usize, line: u32, column: u32) -> Result<(), u32> {
        match self.all.get_mut(symbol) {
            Some(Symbol {
                defined: Some((first, _)),
                ..
            }) => Err(*first),
            Some(s) => {
                s.defined = Some((line, column));
                Ok(())
            }
            None => Ok(()),
        }
    }

    pub fn set(&mut self, symbol: usize, value: i64) {
        if let Some(s) = self.all.get_mut(symbol) {
            s.value = Some(value);
        }
    }

    pub fn value(&self, symbol: usize) -> Option<i64> {
        self.all.get(symbol).and_then(|s| s.value)
    }

    pub fn iter(&self) -> impl Iterator<Item = &Symbol> {
        self.all.iter()
    }

    pub fn get(&self, symbol: usize) -> Option<&Symbol> {
        self.all.get(symbol)
    }

    pub fn name(&self, symbol: usize) -> &str {
        self.get(symbol).map_or("?", |s| &s.name)
    }

    /// Gives values to the definitions that mention later ones, each as soon as
    /// all it mentions has a value: linear in the text, whatever the order.
    /// What is left without a value depends on itself or on something undefined.
    pub fn settle(&mut self, waiting: &[(usize, &Expr, i64)]) -> Vec<(usize, &'static str)> {
        let mut missing: Vec<usize> = Vec::with_capacity(waiting.len());
        let mut users: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let mut ready = VecDeque::new();
        for (i, (_, expr, _)) in waiting.iter().enumerate() {
            let unknown: Vec<usize> = expr
                .mentions()
                .filter(|s| self.value(*s).is_none())
                .collect();
            missing.push(unknown.len());
            if unknown.is_empty() {
                ready.push_back(i);
            }
            for symbol in unknown {
                users.entry(symbol).or_default().push(i);
            }
        }
        let mut wrong = Vec::new();
        while let Some(i) = ready.pop_front() {
            let Some((symbol, expr, here)) = waiting.get(i) else {
                continue;
            };
            match expr.value(self, *here) {
                Ok(value) => self.set(*symbol, value),
                Err(NoValue::Wrong(why)) => {
                    wrong.push((i, why));
                    continue;
                }
                Err(NoValue::Unknown(_)) => continue,
            }
            for user in users.remove(symbol).unwrap_or_default() {
                if let Some(count) = missing.get_mut(user) {
                    *count -= 1;
                    if *count == 0 {
                        ready.push_back(user);
                    }
                }
            }
        }
        wrong
    }
}
