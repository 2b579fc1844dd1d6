//! The two workers of a desk: one reads scenes and draws them, one runs machines.

use super::Build;
use super::desk::Desk;
use super::queue::Errand;
use crate::failure::{Failure, Outcome};
use crate::live::board::Wish;
use crate::live::machine::{self, Kept};
use crate::live::native;
use crate::scene::{Changes, Scene};
use crate::target_args::ScreenArgs;
use slowlight_compiler::planner::PlannedScene;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;

/// The scene that was read last, to be drawn again with other values.
type Read = Option<(Arc<str>, Scene)>;

/// Draws whatever is wanted until the end.
pub fn native(desk: &Desk, changes: &Changes) {
    let mut last = 0;
    let mut read: Read = None;
    while let Some((wish, job)) = desk.next_native(last) {
        last = wish.serial;
        let drawn = catch_unwind(AssertUnwindSafe(|| {
            let scene = scene(desk, &wish, changes, &mut read)?;
            native::drawn(desk, &wish, &job, scene)
        }));
        let drawn = drawn.unwrap_or_else(|_| {
            read = None;
            Err(Failure::Wrong(
                "this scene breaks slowlight, which is no fault of the scene's".to_owned(),
            ))
        });
        match drawn {
            Ok(scene) => desk.ready(wish, Arc::new(scene)),
            Err(failure) => native::refused(desk, &wish, failure),
        }
    }
}

/// Reads the wish's scene, unless it is the text of the last one.
fn scene(desk: &Desk, wish: &Wish, changes: &Changes, read: &mut Read) -> Outcome<Scene> {
    if let Some((text, scene)) = read
        && **text == *wish.text
        && !desk.file().is_any_stale()
    {
        return Ok(scene.clone());
    }
    *read = None;
    let file = desk.file();
    file.begin();
    let mut used = |from: &str, path: &str| file.used(from, path);
    let named = (&*file.name(), &*wish.text);
    let scene = Scene::of_text(named, file.named(), changes, &mut used)?;
    *read = Some((wish.text.clone(), scene.clone()));
    Ok(scene)
}

/// Does what machines are asked for until the end, one thing after the other: the native
/// picture has a processor of its own, however many machines stand beside each other.
pub fn machine(desk: &Desk, build: Build) {
    let mut kept = Kept::default();
    let build = |plan: &PlannedScene, screen: &ScreenArgs| built(desk, build, plan, screen);
    while let Some(errand) = desk.next_task() {
        let Errand {
            task,
            run,
            scene,
            job,
        } = &errand;
        let before = (desk.shown().1.panels.get(run.panel)).map(|panel| panel.machine.stage);
        let done = catch_unwind(AssertUnwindSafe(|| {
            job.doing(|| machine::done(desk, run, scene, *task, (&mut kept, &build)))
        }));
        let done = done.unwrap_or_else(|_| {
            kept = Kept::default();
            Err(Failure::Wrong(
                "this program breaks slowlight, which is no fault of the scene's".to_owned(),
            ))
        });
        machine::ended(desk, run, (*task, before.unwrap_or_default()), done);
    }
}

/// Writes the program's files into the scene's directory; answers their names.
fn built(
    desk: &Desk,
    build: Build,
    plan: &PlannedScene,
    screen: &ScreenArgs,
) -> Outcome<Vec<String>> {
    let file = desk.file();
    // A scene that is called like one of its program's files would be written over.
    if file.named().extension().is_none_or(|e| e != "scn") {
        let why = "the program's files could take the scene's own place: call it NAME.scn";
        return Err(Failure::Wrong(why.to_owned()));
    }
    let paths = build(plan, screen, file.directory())?;
    let name = |path: &PathBuf| {
        let name = path.file_name().unwrap_or(path.as_os_str());
        name.to_string_lossy().into_owned()
    };
    Ok(paths.iter().map(name).collect())
}
