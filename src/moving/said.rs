//! What is said of a walk on a machine: as a table, and as JSON.

use super::run::{Shown, State, Walk};
use crate::draw::Window;
use crate::format::{count, table};
use crate::trial::mode_json;
use serde_json::{Value as Json, json};

/// How many pictures that are unlike the model's are listed.
const LISTED: usize = 10;

impl Walk {
    /// What `run --pictures` prints.
    pub fn text(&self, scene: &str) -> String {
        let plan = &self.plan;
        let window = Window::on_screen(plan);
        let (model, native) = self.pixels_unlike();
        let row = |what: &str, value: String| vec![what.to_owned(), value];
        let pixels = window.count() * self.pictures.len();
        let mut rows = vec![
            row("pictures", count(self.pictures.len() as u64)),
            row("pixels", count(pixels as u64)),
            row("cycles to the first", count(self.first_cycles())),
            row(
                "cycles a picture",
                count(self.cycles_a_picture().round() as u64),
            ),
            row(
                "pictures a second",
                match self.pictures_a_second() {
                    few @ ..1.0 => format!("{few:.3}"),
                    many => format!("{many:.2}"),
                },
            ),
            row("pixels unlike the model's", count(model as u64)),
            row(
                "states unlike the model's",
                count(self.states_unlike() as u64),
            ),
            row("pixels unlike the native ones", count(native as u64)),
            row(
                "ints and bools unlike the native step's",
                count(self.steps_unlike() as u64),
            ),
        ];
        if plan.target.columns_only {
            let said = String::from_utf8_lossy(&self.run.output).into_owned();
            rows.push(row("frames", said.trim().to_owned()));
        }
        let last = self.pictures.last();
        for state in last.iter().flat_map(|shown| &shown.states) {
            rows.push(row(
                &format!("{} at last", state.name),
                state.written(state.is),
            ));
        }
        let (width, height) = (window.width(), window.height());
        let (target, format) = (plan.target.name, plan.runtime.format);
        let title = format!("{scene}: {target}, {format}, {width} x {height} pixels\n");
        let mut text = title + &table(&rows);
        let unlike = |shown: &&(usize, &Shown)| {
            let unlike = |state: &State| !state.same || state.natively.is_some();
            !shown.1.from_model.is_empty() || shown.1.states.iter().any(unlike)
        };
        let all: Vec<(usize, &Shown)> = self.pictures.iter().enumerate().collect();
        for (at, shown) in all.iter().filter(unlike).take(LISTED) {
            let pixels = match shown.from_model.len() {
                1 => "1 pixel".to_owned(),
                n => format!("{n} pixels"),
            };
            text.push_str(&format!("picture {at}: {pixels} unlike the model's"));
            for state in &shown.states {
                let (name, is) = (&state.name, state.written(state.is));
                if !state.same {
                    let should = state.written(state.should);
                    text.push_str(&format!(", {name} is {is} and should be {should}"));
                }
                if let Some(value) = state.natively {
                    let value = state.written(value);
                    text.push_str(&format!(", {name} is {is} and natively {value}"));
                }
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
            let natively = shown.states.iter();
            let natively = natively.filter_map(|s| Some((s.name.clone(), json!(s.natively?))));
            json!({
                "inks_sha256": shown.picture.sha256(),
                "differs_from_model": shown.from_model.len(),
                "differs_from_native": shown.from_native.len(),
                "states": states.collect::<serde_json::Map<_, _>>(),
                "states_of_model": unlike.collect::<serde_json::Map<_, _>>(),
                "states_of_native_step": natively.collect::<serde_json::Map<_, _>>(),
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
            "cycles_to_first": self.first_cycles(),
            "cycles_per_picture": self.cycles_a_picture(),
            "pictures_per_second": self.pictures_a_second(),
            "differs_from_model": model,
            "differs_from_native": native,
            "states_differ": self.states_unlike(),
            "steps_differ_from_native": self.steps_unlike(),
            "pictures": pictures.collect::<Vec<_>>(),
        })
    }
}
