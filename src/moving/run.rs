//! A walk on a machine: every picture and state held against the model's, which go on from the
//! machine's own states.

use super::hands::Hands;
use super::places::{Places, bits_of};
use super::walk::label;
use crate::draw::{Drawn, Window, model_with, native};
use crate::failure::{Failure, Outcome};
use crate::format::{count, table};
use crate::machine::{Loaded, Machine, MachineRun, complaint};
use crate::measure::{Difference, differences};
use crate::picture::Picture;
use crate::progress::{Progress, Waiting};
use crate::scene::{Precision, Scene};
use crate::trial::{mode_json, shown};
use serde_json::{Value as Json, json};
use slowlight_compiler::ir::graph::{Graph, Param, ParamId};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::PlannedScene;
use slowlight_routine::{Bits, Value};
use slowlight_vm::Screen;
use slowlight_vm::keys::{Keyboard, Unit};

/// How many pictures that are unlike the model's are listed.
const LISTED: usize = 10;

/// A state in a picture.
#[derive(Clone, Debug)]
pub struct State {
    /// Its name.
    pub name: String,
    /// Its value on the machine.
    pub is: f64,
    /// What the model makes of the picture before.
    pub should: f64,
    /// Whether the two have the same bits.
    pub same: bool,
}

/// A picture of the walk.
pub struct Shown {
    /// The machine's.
    pub picture: Picture,
    /// Where it is unlike the model's.
    pub from_model: Vec<Difference>,
    /// Where it is unlike the native one of the same states.
    pub from_native: Vec<Difference>,
    /// The states that it was drawn with.
    pub states: Vec<State>,
}

/// A walk on a machine.
pub struct Walk {
    /// The plan.
    pub plan: PlannedScene,
    /// The machine's counts.
    pub run: MachineRun,
    /// Picture by picture.
    pub pictures: Vec<Shown>,
}

/// Runs so many pictures of a program, and holds them against its plan.
///
/// # Errors
/// Where the machine cannot be followed, or the program ends before.
pub fn run(
    scene: &Scene,
    plan: PlannedScene,
    (mut loaded, machine): (Loaded, Machine),
    (pictures, hands): (u32, &Hands),
    limit: u64,
) -> Outcome<Walk> {
    let followed = match machine {
        Machine::Hack(config) => !config.cpu && !config.os,
        Machine::Mos6502(_) => true,
        Machine::Bbc(_) => false,
    };
    if !followed {
        let message = "--pictures: of the Hack, only the VM with its native system is followed yet";
        return Err(Failure::Usage(message.to_owned()));
    }
    let script = hands.script().clone().filmed(u64::from(pictures));
    let keyboard = Keyboard::new(script, Unit::Calls, |_| None).remembering();
    let (run, keyboard) = {
        let _waiting = Waiting::new("the machine");
        loaded.play(keyboard, limit, &mut |_| {})?
    };
    let name = plan.target.name;
    if let Some(wrong) = complaint(&run, limit) {
        return Err(Failure::Wrong(format!("{name}: {wrong}")));
    }
    let kept = keyboard.shots().iter().map(|(_, screen)| screen.as_ref());
    let seen: Vec<(Option<&Screen>, &Vec<i16>)> = kept.zip(keyboard.memories()).collect();
    if seen.len() != pictures as usize {
        let message = format!("{name}: the program ended after {} pictures", seen.len());
        return Err(Failure::Wrong(message));
    }
    let native_graph = scene.graph(Some(plan.mode.inks), Precision::NATIVE)?;
    let mut follow = Follow::new(&plan, native_graph);
    let progress = Progress::new("pictures", u64::from(pictures));
    let mut found = Vec::new();
    for (at, (screen, memory)) in (0..).zip(seen) {
        found.push(follow.picture(screen, memory)?);
        follow.step(hands, at);
        progress.step(1);
    }
    Ok(Walk {
        plan,
        run,
        pictures: found,
    })
}

/// The model and the native evaluation beside a machine.
struct Follow<'p> {
    plan: &'p Plan,
    /// The same with the states as they are now.
    now: Plan,
    native: Graph,
    places: Places,
    /// What the states should be.
    should: Vec<(ParamId, Bits)>,
}

impl<'p> Follow<'p> {
    fn new(plan: &'p Plan, native: Graph) -> Follow<'p> {
        let steps = plan.graph.steps();
        let start = steps.map(|(id, _)| (id, bits_of(plan, id)));
        Follow {
            now: plan.clone(),
            native,
            places: Places::of(plan),
            should: start.collect(),
            plan,
        }
    }

    /// A picture with the states that the machine has drawn it with.
    fn picture(&mut self, screen: Option<&Screen>, memory: &[i16]) -> Outcome<Shown> {
        let plan = self.plan;
        let mut states = Vec::new();
        for (id, should) in self.should.clone() {
            // What nothing reads is nowhere, and as it should be.
            let is = match self.places.held(plan, (id, should), memory) {
                Some(None) => {
                    let message = "the machine's memory does not hold the states".to_owned();
                    return Err(Failure::Wrong(message));
                }
                Some(Some(is)) => is,
                None => should,
            };
            if let Some(param) = self.now.params.get_mut(id.0 as usize) {
                param.bits = is;
            }
            let Some(param) = plan.graph.params.get(id.0 as usize) else {
                continue;
            };
            let [is_value, should_value] = [is, should].map(|bits| value(plan, id, bits));
            native_param(&mut self.native, param)
                .iter_mut()
                .for_each(|own| own.value = is_value);
            states.push(State {
                name: label(param),
                is: is_value,
                should: should_value,
                same: is == should,
            });
        }
        let window = Window::on_screen(plan);
        let modelled = model_with(&self.now, None)?;
        let native = native(&self.native, window)?;
        let picture = shown(plan, screen)?;
        let unlike = |other: &Drawn| differences(window.places(), &picture.inks, &other.pixels);
        Ok(Shown {
            from_model: unlike(&modelled),
            from_native: unlike(&native),
            states,
            picture,
        })
    }

    /// What the states should be in the next picture.
    fn step(&mut self, hands: &Hands, picture: u32) {
        let held = hands.held(picture);
        let plan = self.plan;
        for (id, button) in plan.graph.buttons() {
            let value = Value::Int(i32::from(held == Some(button)));
            let bits = (plan.runtime.encode)(value, plan.runtime.int);
            if let Some(param) = self.now.params.get_mut(id.0 as usize) {
                param.bits = bits;
            }
        }
        self.should = ModelRun::new(&self.now).next_states();
    }
}

fn native_param<'g>(graph: &'g mut Graph, like: &Param) -> Option<&'g mut Param> {
    let mut params = graph.params.iter_mut();
    params.find(|p| (&p.name, p.component) == (&like.name, like.component))
}

/// A state's bits as a number.
fn value(plan: &Plan, id: ParamId, bits: Bits) -> f64 {
    match (plan.runtime.decode)(bits, plan.param_format(id)) {
        Value::Real(x) => x,
        Value::Int(i) => f64::from(i),
        Value::Bool(b) => f64::from(u8::from(b)),
    }
}

impl Walk {
    /// Whether the machine did other than its model, in a picture or a state.
    pub fn differs(&self) -> bool {
        let differs = |shown: &Shown| {
            !shown.from_model.is_empty() || shown.states.iter().any(|state| !state.same)
        };
        self.pictures.iter().any(differs)
    }

    /// How many pixels are unlike the model's, and unlike the native ones.
    pub fn pixels_unlike(&self) -> (usize, usize) {
        let model = self.pictures.iter().map(|shown| shown.from_model.len());
        let native = self.pictures.iter().map(|shown| shown.from_native.len());
        (model.sum(), native.sum())
    }

    /// How many states are unlike the model's.
    pub fn states_unlike(&self) -> usize {
        let states = self.pictures.iter().flat_map(|shown| &shown.states);
        states.filter(|state| !state.same).count()
    }

    /// The machine's cycles a picture, what comes before the first among them.
    pub fn cycles_a_picture(&self) -> f64 {
        self.run.cycles as f64 / self.pictures.len().max(1) as f64
    }

    /// What `run --pictures` prints.
    pub fn text(&self, scene: &str) -> String {
        let plan = &self.plan;
        let window = Window::on_screen(plan);
        let (model, native) = self.pixels_unlike();
        let row = |what: &str, value: String| vec![what.to_owned(), value];
        let pixels = window.count() * self.pictures.len();
        let a_second = plan.target.hertz / self.cycles_a_picture();
        let mut rows = vec![
            row("pictures", count(self.pictures.len() as u64)),
            row("pixels", count(pixels as u64)),
            row("cycles", count(self.run.cycles)),
            row(
                "cycles a picture",
                count(self.cycles_a_picture().round() as u64),
            ),
            row("pictures a second", format!("{a_second:.2}")),
            row("pixels unlike the model's", count(model as u64)),
            row(
                "states unlike the model's",
                count(self.states_unlike() as u64),
            ),
            row("pixels unlike the native ones", count(native as u64)),
        ];
        let last = self.pictures.last();
        for state in last.iter().flat_map(|shown| &shown.states) {
            rows.push(row(
                &format!("{} at last", state.name),
                format!("{:.6}", state.is),
            ));
        }
        let (width, height) = (window.width(), window.height());
        let (target, format) = (plan.target.name, plan.runtime.format);
        let title = format!("{scene}: {target}, {format}, {width} x {height} pixels\n");
        let mut text = title + &table(&rows);
        let unlike = |shown: &&(usize, &Shown)| {
            !shown.1.from_model.is_empty() || shown.1.states.iter().any(|state| !state.same)
        };
        let all: Vec<(usize, &Shown)> = self.pictures.iter().enumerate().collect();
        for (at, shown) in all.iter().filter(unlike).take(LISTED) {
            let pixels = shown.from_model.len();
            text.push_str(&format!("picture {at}: {pixels} pixels unlike the model's"));
            for state in shown.states.iter().filter(|state| !state.same) {
                let State {
                    name, is, should, ..
                } = state;
                text.push_str(&format!(", {name} is {is} and should be {should}"));
            }
            text.push('\n');
        }
        text
    }

    /// What `run --pictures --json` prints.
    pub fn report(&self, scene: &str) -> Json {
        let plan = &self.plan;
        let (model, native) = self.pixels_unlike();
        let window = Window::on_screen(plan);
        let pictures = self.pictures.iter().map(|shown| {
            let states = shown.states.iter();
            let states = states.map(|state| (state.name.clone(), json!(state.is)));
            let unlike = shown.states.iter().filter(|state| !state.same);
            let unlike = unlike.map(|state| (state.name.clone(), json!(state.should)));
            json!({
                "inks_sha256": shown.picture.sha256(),
                "differs_from_model": shown.from_model.len(),
                "differs_from_native": shown.from_native.len(),
                "states": states.collect::<serde_json::Map<_, _>>(),
                "states_of_model": unlike.collect::<serde_json::Map<_, _>>(),
            })
        });
        json!({
            "scene": scene,
            "target": plan.target.name,
            "mode": mode_json(plan.mode.name),
            "format": plan.runtime.format,
            "width": window.width(),
            "height": window.height(),
            "cycles": self.run.cycles,
            "cycles_per_picture": self.cycles_a_picture(),
            "pictures_per_second": plan.target.hertz / self.cycles_a_picture(),
            "differs_from_model": model,
            "differs_from_native": native,
            "states_differ": self.states_unlike(),
            "pictures": pictures.collect::<Vec<_>>(),
        })
    }
}
