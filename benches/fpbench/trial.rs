//! Trials: the bound that is proved of a core's value, and the worst error at points at random.

use crate::core::Core;
use crate::random::Random;
use crate::within::may_hold;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::ir::graph::ParamId;
use slowlight_compiler::plan::error::{Tile, bound_within};
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::plan::{Goal, Plan};
use slowlight_compiler::planner::plan_as_written;
use slowlight_compiler::sema::Options;
use slowlight_compiler::targets::{Target, default_mode};
use slowlight_compiler::{ir::graph::NodeId, scene};
use slowlight_routine::{Range, Value};

/// How a core fared in a format.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fared {
    /// The most that its value may be off, as proved; infinite where nothing is.
    pub proved: f64,
    /// Whether a comparison may come out otherwise in the machine: then nothing is proved.
    pub undecided: bool,
    /// The most that it was off.
    pub measured: f64,
    /// At how many points it was looked at.
    pub points: usize,
    /// At how many of them it was off by more than was proved.
    pub exceeded: usize,
}

impl Fared {
    pub fn ratio(&self) -> Option<f64> {
        let known = self.proved.is_finite() && self.measured > 0.0;
        known.then(|| self.proved / self.measured)
    }
}

/// Plans a core for a target, as it is written.
pub fn planned(core: &Core, target: &'static Target) -> Result<Plan, String> {
    let scene = scene::check(&core.name, &core.scene);
    if !scene.is_right() {
        return Err(format!("{:?}", scene.diagnostics));
    }
    let options = Options {
        offset: target.offset,
        ..Options::default()
    };
    let graph = scene.lower(&options).map_err(|e| format!("{e:?}"))?;
    let goal = Goal {
        name: "core".to_owned(),
        mode: default_mode(target, 1, 1).ok_or("no mode")?,
        rows: None,
        plot: true,
    };
    match plan_as_written(&graph, target, &goal) {
        Ok(planned) => Ok(planned.plan),
        Err(said) => Err(said.first().map_or(String::new(), |d| d.message.clone())),
    }
}

/// Proves a bound, and looks at so many points.
pub fn tried(core: &Core, mut plan: Plan, points: usize, fuel: u64) -> Result<Fared, String> {
    let shade = plan.graph.shade.ok_or("no shade")?;
    let inputs = inputs(core, &plan)?;
    let mut fared = proved(core, &plan, shade, &inputs, fuel);
    let mut random = Random::new(0);
    // A precondition that hardly any point meets ends the search for points.
    for _ in 0..points.saturating_mul(1000) {
        if fared.points == points {
            break;
        }
        let at: Vec<Range> = (inputs.iter().zip(0..))
            .map(|(input, k)| Range::point(input.draw(&mut plan, ParamId(k), &mut random)))
            .collect();
        if !may_hold(&core.pre, &named(core, &inputs, &at)) {
            continue;
        }
        let native = Native::new(&plan.graph).pixel(0, 0).shade;
        let off = (ModelRun::new(&plan).pixel(0, 0).shade - native).abs();
        fared.points += 1;
        fared.measured = fared.measured.max(off);
        fared.exceeded += usize::from(off > fared.proved);
    }
    Ok(fared)
}

/// An input as the plan has it.
struct Input {
    /// Which of the core's inputs it is.
    of: usize,
    ends: [f64; 2],
}

impl Input {
    /// Gives a param a value at random, as the machine holds it, and says it.
    fn draw(&self, plan: &mut Plan, id: ParamId, random: &mut Random) -> f64 {
        const ALL: u64 = 1 << 40;
        let part = random.below(ALL) as f64 / ALL as f64;
        let [lo, hi] = self.ends;
        let (bits, value) = held(plan, id, lo + (hi - lo) * part);
        let k = id.0 as usize;
        plan.params[k].bits = bits;
        plan.graph.params[k].value = value;
        value
    }
}

/// A number as the machine holds it in a param.
fn held(plan: &Plan, id: ParamId, value: f64) -> (u64, f64) {
    let format = plan.param_format(id);
    let bits = (plan.runtime.encode)(Value::Real(value), format);
    (bits, (plan.runtime.decode)(bits, format).real())
}

/// The plan's params, in its order: those that nothing asks for are none of them.
fn inputs(core: &Core, plan: &Plan) -> Result<Vec<Input>, String> {
    let number = |name: &str| name.strip_prefix('p')?.parse::<usize>().ok();
    let each = plan.graph.params.iter().map(|param| {
        let of = number(&param.name).ok_or("a param of another name")?;
        let (_, ends) = core.inputs.get(of).ok_or("a param too many")?;
        Ok(Input { of, ends: *ends })
    });
    each.collect()
}

/// The inputs by their names in the core.
fn named(core: &Core, inputs: &[Input], at: &[Range]) -> Vec<(String, Range)> {
    let all = core.inputs.iter().enumerate();
    let each = all.map(|(k, (name, [lo, hi]))| {
        let found = inputs.iter().zip(at).find(|(input, _)| input.of == k);
        (name.clone(), found.map_or(Range::new(*lo, *hi), |f| *f.1))
    });
    each.collect()
}

fn proved(core: &Core, plan: &Plan, shade: NodeId, inputs: &[Input], fuel: u64) -> Fared {
    let ends = inputs.iter().zip(0..).map(|(input, k)| {
        let [lo, hi] = input.ends.map(|end| held(plan, ParamId(k), end).1);
        (
            Range::new(lo.min(input.ends[0]), hi.max(input.ends[1])),
            0.0,
        )
    });
    let mut tile = Tile::of(plan, (0, 0), (0, 0));
    tile.params = ends.collect();
    let keep = |at: &[(Range, f64)]| {
        let at: Vec<Range> = at.iter().map(|(range, _)| *range).collect();
        may_hold(&core.pre, &named(core, inputs, &at))
    };
    let found = bound_within(plan, &tile, shade, fuel, &keep);
    Fared {
        proved: found.error,
        undecided: found.undecided,
        ..Fared::default()
    }
}
