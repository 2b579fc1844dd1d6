//! The scenes of `examples/hard` on every target: no trap, no run without end,
//! no pixel that the model does not foretell, no hole and no speckle.
//!
//! A hole or a speckle is a connected region of more than [`SPECK`] pixels
//! where the machine's shade, before the dither, is off from the native one by
//! more than half a level. Regions are 8-connected: pixels that touch at a
//! corner are one region, so that more of them are too large than with
//! 4-connection. The levels are the image's inks, whichever the target has, so
//! a machine with two inks is held to what four can show.
//!
//! Outlines are left out, widened by a pixel: there any format may decide
//! otherwise. They are not guessed from shades. Each scene has a function
//! `object` that says as a number what a pixel shows; the scene is drawn
//! natively a second time with that number as its shade, and an outline is
//! where neighbours differ in it. In mirrors it is the number of bounces.

use slowlight::draw::{Window, deep, model, native};
use slowlight::scene::{Scene, SceneArgs};
use slowlight::target_args::ScreenArgs;
use slowlight::trial;
use slowlight_compiler::scene::check;
use slowlight_compiler::sema::Options;
use slowlight_compiler::targets::find;
use slowlight_vm::Stop;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The largest region that is no fault, in pixels.
const SPECK: usize = 4;

/// A run that takes longer has lost its way: three times the slowest, the torus in BASIC.
const BOUND: u64 = 100_000_000_000;

fn scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hard");
    let files = std::fs::read_dir(folder).expect("the folder");
    let mut paths: Vec<PathBuf> = files.map(|f| f.expect("a file").path()).collect();
    paths.sort();
    assert!(paths.len() >= 9, "{paths:?}");
    paths
}

/// Where neighbours show different things, and a pixel around.
fn outlines(source: &str, size: (u32, u32)) -> Vec<bool> {
    let (items, _) = source
        .rsplit_once("\ndraw (x, y) =")
        .expect("an item `draw`");
    let text = format!("{items}\ndraw (x, y) = threshold(object(x, y), 0);\n");
    let scene = check("objects", &text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let graph = scene.lower(&Options::default()).expect("a graph");
    let window = Window::whole(size.0, size.1);
    let drawn = native(&graph, window).expect("a picture");
    let shown: Vec<f64> = drawn.pixels.iter().map(|p| p.shade).collect();
    let edges: Vec<bool> = (0..shown.len())
        .map(|k| around(k, size).any(|n| shown.get(n) != shown.get(k)))
        .collect();
    (0..shown.len())
        .map(|k| edges[k] || around(k, size).any(|n| edges[n]))
        .collect()
}

/// The pixels that touch one, at sides and corners.
fn around(k: usize, (width, height): (u32, u32)) -> impl Iterator<Item = usize> {
    let (x, y) = (k as i64 % i64::from(width), k as i64 / i64::from(width));
    let place = move |(dx, dy)| {
        let (x, y): (i64, i64) = (x + dx, y + dy);
        let inside = (0..i64::from(width)).contains(&x) && (0..i64::from(height)).contains(&y);
        inside.then(|| (y * i64::from(width) + x) as usize)
    };
    let near = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
    near.filter(|&d| d != (0, 0)).filter_map(place)
}

/// The pixels of each 8-connected region.
fn regions(wrong: &[bool], size: (u32, u32)) -> Vec<Vec<usize>> {
    let mut left: BTreeSet<usize> = (0..wrong.len()).filter(|&k| wrong[k]).collect();
    let mut found = Vec::new();
    while let Some(first) = left.pop_first() {
        let mut region = vec![first];
        let mut next = 0;
        while let Some(&k) = region.get(next) {
            region.extend(around(k, size).filter(|n| left.remove(n)));
            next += 1;
        }
        found.push(region);
    }
    found
}

/// What is wrong with a scene on a target; empty where nothing is.
fn faults(path: &Path, target: &str) -> Vec<String> {
    let args = SceneArgs {
        scene: path.to_owned(),
        changes: Default::default(),
    };
    let scene = Scene::load(&args)
        .map_err(|f| format!("{f:?}"))
        .expect("a scene");
    let target = find(target).expect("the target");
    let plan = ScreenArgs::default().plan(&scene, target, &[]);
    let plan = plan.map_err(|f| format!("{f:?}")).expect("a plan");
    let built = trial::build(&plan).map_err(|f| format!("{f:?}"));
    let modelled = model(&plan).expect("the model");
    let loaded = built.expect("a program").loaded;
    let run = trial::run(&scene, plan, &[], loaded, BOUND);
    let run = run.map_err(|f| format!("{f:?}")).expect("a run that ends");
    let mut faults = Vec::new();
    if run.run.stop != Stop::Ended {
        faults.push(format!("it stopped: {:?}", run.run.stop));
    }
    let differs = run.from_model.as_ref().map(Vec::len);
    if differs != Some(0) {
        faults.push(format!("{differs:?} pixels are not the model's"));
    }
    let size = scene.size();
    let source = std::fs::read_to_string(path).expect("a scene");
    let outlines = outlines(&source, size);
    let levels = scene
        .checked
        .program
        .image
        .as_ref()
        .map_or(2, |i| i.palette.len());
    let most = 0.5 / levels as f64;
    let pairs = modelled
        .pixels
        .iter()
        .zip(&run.native.pixels)
        .zip(&outlines);
    let wrong: Vec<bool> = pairs
        .map(|((is, should), outline)| !outline && (is.shade - should.shade).abs() > most)
        .collect();
    let judged = outlines.iter().filter(|o| !**o).count();
    if 2 * judged < outlines.len() {
        faults.push(format!("only {judged} pixels are off outlines"));
    }
    let large = regions(&wrong, size)
        .into_iter()
        .filter(|r| r.len() > SPECK);
    let at = |r: &Vec<usize>| (r[0] as u32 % size.0, r[0] as u32 / size.0);
    let large: Vec<String> = large
        .map(|r| format!("{} from {:?}", r.len(), at(&r)))
        .collect();
    if !large.is_empty() {
        faults.push(format!("regions that are off: {}", large.join(", ")));
    }
    faults
}

fn sound(target: &str) {
    let mut all = String::new();
    for path in scenes() {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let found = deep(|| Ok(faults(&path, target)));
        for fault in found.unwrap_or_else(|f| vec![format!("{f:?}")]) {
            all += &format!("{name} on {target}: {fault}\n");
        }
    }
    assert!(all.is_empty(), "{all}");
}

#[test]
fn hard_scenes_are_sound_in_bbc_basic() {
    sound("bbc:micro");
}

#[test]
fn hard_scenes_are_sound_in_jack() {
    sound("jack");
}

#[test]
fn hard_scenes_are_sound_on_the_6502() {
    sound("6502:plain");
}

#[test]
fn regions_touch_at_corners_too() {
    let picture = "#..#.#\n.#....\n..#..#\n....##";
    let wrong: Vec<bool> = picture
        .bytes()
        .filter(|b| *b != b'\n')
        .map(|b| b == b'#')
        .collect();
    let mut sizes: Vec<usize> = regions(&wrong, (6, 4)).iter().map(Vec::len).collect();
    sizes.sort_unstable();
    assert_eq!(sizes, [1, 1, 3, 3]);
}

#[test]
fn outlines_are_where_objects_meet_and_a_pixel_around() {
    let source = "image 8 x 3 inks black, white;\nfn object(x: int, y: int) -> int = x div 4;\ndraw (x, y) = ink(0);";
    let row = [false, false, true, true, true, true, false, false];
    assert_eq!(outlines(source, (8, 3)), [row, row, row].concat());
}
