//! Scenes: their members, and the one type of their tags.

use super::names::Entity;
use super::{Checker, Context, State};
use crate::sema::program::*;
use crate::sema::ty::Ty;
use crate::source::{Diagnostic, Span};
use crate::syntax::tree;

/// The type of a scene's tags so far, and the first shape that has one.
type Tag = Option<(Ty, Span)>;

/// The `each`s around a member: what they count, and where they say so.
type Counters = Vec<(String, Span)>;

impl Checker<'_> {
    /// A scene's tags' type, found on demand.
    pub(super) fn scene(&mut self, id: SceneId) -> Ty {
        if let State::Todo(trees) = self.scenes[id.0] {
            self.scenes[id.0] = State::Busy;
            let before = (
                std::mem::take(&mut self.diagnostics),
                std::mem::take(&mut self.mentions),
            );
            let mut tag = None;
            let mut members = self.members(id, trees, &mut Counters::new(), &mut tag);
            if trees.is_empty() {
                let span = self.program.scenes[id.0].span;
                self.error(span, "a scene has at least one shape");
            }
            if let Some((ty, first)) = &tag {
                if !ty.is_data() {
                    let message = format!("a tag cannot be {}", self.a(ty));
                    self.error(*first, message);
                }
                self.settle_tags(&mut members, trees, ty, *first);
            }
            self.settle(before.0, before.1);
            let scene = &mut self.program.scenes[id.0];
            (scene.tag, scene.members) = (tag.map(|(ty, _)| ty), members);
            self.scenes[id.0] = State::Done;
        }
        match self.scenes[id.0] {
            State::Done => Ty::Scene(self.program.scenes[id.0].tag.clone().map(Box::new)),
            _ => Ty::Error,
        }
    }

    // Recursion is bounded, here and below: the parser nests no deeper than its limit.
    fn members(
        &mut self,
        id: SceneId,
        trees: &[tree::Member],
        counters: &mut Counters,
        tag: &mut Tag,
    ) -> Vec<Member> {
        let mut found = Vec::new();
        for tree in trees {
            found.push(match tree {
                tree::Member::One { shape, tag: mark } => {
                    self.member(id, shape, mark.as_ref(), counters, tag)
                }
                tree::Member::Each { counter, members } => {
                    let (low, high) = self.bounds(counter, |c, bound, what| {
                        let cx = c.inside_scene(id, counters);
                        c.body(cx, &locals(counters), bound, Some((&Ty::Int, what)))
                    });
                    self.hides(&counter.name, counters);
                    if counter.name.text == "p" {
                        let message = "a tag knows `p` as the point hit";
                        let error = Diagnostic::error(counter.name.span, message);
                        self.report(error.help("choose another name: `k`"));
                    }
                    if members.is_empty() {
                        self.error(counter.span, "this `each` has no shape to repeat");
                    }
                    counters.push((counter.name.text.clone(), counter.name.span));
                    let members = self.members(id, members, counters, tag);
                    counters.pop();
                    Member::Each {
                        name: counter.name.text.clone(),
                        low,
                        high,
                        members,
                        span: counter.span,
                    }
                }
            });
        }
        found
    }

    /// The context of a scene's expressions.
    fn inside_scene(&self, id: SceneId, counters: &Counters) -> Context {
        Context {
            counters: counters.clone(),
            ..Self::context(Entity::Scene(id), false)
        }
    }

    fn member(
        &mut self,
        id: SceneId,
        shape: &tree::Expr,
        mark: Option<&tree::Expr>,
        counters: &Counters,
        tag: &mut Tag,
    ) -> Member {
        let want = Some((&Ty::Shape, "a member of a scene"));
        let mut locals = locals(counters);
        let made = self.body(self.inside_scene(id, counters), &locals, shape, want);
        locals.insert(0, ("p".to_owned(), Ty::Vector(3)));
        let mark = mark.map(|tree| self.body(self.inside_scene(id, counters), &locals, tree, None));
        if let Some(mark) = &mark {
            let ty = &mark.value.ty;
            match tag {
                None => *tag = Some((ty.clone(), shape.span)),
                Some((old, first)) => match old.join(ty) {
                    Some(joined) => *old = joined,
                    None => {
                        let message =
                            format!("this tag is {}, an earlier one {}", self.a(ty), self.a(old));
                        let error = Diagnostic::error(mark.value.span, message);
                        let error = error.help("all tags of a scene have one type");
                        self.report(error.also(*first, "the first tag is here"));
                    }
                },
            }
        }
        Member::One {
            shape: made,
            tag: mark,
        }
    }

    /// Makes all tags of one type, and finds shapes without any.
    fn settle_tags(
        &mut self,
        members: &mut [Member],
        trees: &[tree::Member],
        ty: &Ty,
        first: Span,
    ) {
        for (member, tree) in members.iter_mut().zip(trees) {
            match (member, tree) {
                (Member::Each { members, .. }, tree::Member::Each { members: trees, .. }) => {
                    self.settle_tags(members, trees, ty, first)
                }
                (
                    Member::One {
                        tag: Some(mark), ..
                    },
                    _,
                ) => {
                    let value = std::mem::replace(&mut mark.value, Expr::error(Span::default()));
                    mark.value = match value.ty.fits(ty) {
                        true => super::widen(value, ty),
                        false => Expr::error(value.span),
                    };
                }
                (_, tree::Member::One { shape, .. }) => {
                    let error = Diagnostic::error(shape.span, "this shape has no tag");
                    let error = error.also(first, "this one has one");
                    self.report(error.help("give every shape of the scene a tag, or none"));
                }
                _ => {}
            }
        }
    }
}

/// The first locals of what stands in these `each`s.
fn locals(counters: &Counters) -> Vec<(String, Ty)> {
    let names = counters.iter().map(|(name, _)| name.clone());
    names.map(|name| (name, Ty::Int)).collect()
}
