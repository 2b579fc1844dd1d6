//! FPCore translation: a core as a scene of one pixel, its inputs as params with ranges.

use super::reader::Form;
use super::within::{ends, number};

/// A core that the scene language can say.
pub struct Core {
    pub name: String,
    /// Each input's name in the core, and between which ends its precondition has it.
    pub inputs: Vec<(String, [f64; 2])>,
    /// What holds of the inputs, beside and with their ends.
    pub pre: Form,
    /// The scene: input k is the param `p{k}`, the core's value the shade.
    pub scene: String,
}

/// What a core is called, and what it is as a scene, or why it is none.
pub fn core(form: &Form) -> Option<(String, Result<Core, String>)> {
    let [head, inputs, rest @ ..] = form.list() else {
        return None;
    };
    if head.word() != "FPCore" {
        return None;
    }
    // A core may bear a name before its inputs.
    let (inputs, rest) = match (inputs, rest) {
        (Form::Word(_), [inputs, rest @ ..]) => (inputs, rest),
        _ => (inputs, rest),
    };
    let value = rest.last()?;
    let property = |name: &str| {
        let at = rest.iter().position(|f| f.word() == name)?;
        rest.get(at + 1)
    };
    let name = property(":name").map_or("", |f| f.word());
    let name = name.trim_start_matches('"').to_owned();
    let none = Form::Word("TRUE".to_owned());
    let pre = property(":pre").unwrap_or(&none).clone();
    Some((name.clone(), said(name, inputs, pre, value)))
}

fn said(name: String, inputs: &Form, pre: Form, value: &Form) -> Result<Core, String> {
    let names: Vec<String> = (inputs.list().iter())
        .map(|input| input.list().last().unwrap_or(input).word().to_owned())
        .collect();
    let mut says = Says::default();
    let mut known: Vec<(String, String)> = Vec::new();
    let mut params = String::new();
    let mut all = Vec::new();
    for (k, name) in names.iter().enumerate() {
        known.push((name.clone(), format!("p{k}")));
    }
    let value = says.value(value, &known)?;
    for (k, name) in names.iter().enumerate() {
        let [lo, hi] = ends(&pre, name);
        if !lo.is_finite() || !hi.is_finite() {
            return Err("an input has no range".to_owned());
        }
        let (lo_text, hi_text, middle) = (literal(lo), literal(hi), literal(lo + (hi - lo) / 2.0));
        params += &format!("param p{k}: real = {middle} in {lo_text} .. {hi_text};\n");
        all.push((name.clone(), [lo, hi]));
    }
    let lets = says.lets;
    let scene = format!(
        "image 1 x 1 inks black, white;\n{params}\
         dither shown(v: real, x: int, y: int) -> ink = ink(floor(v * 8) mod 2);\n\
         draw (x, y) = {{\n{lets}  shown({value}, x, y)\n}};\n"
    );
    Ok(Core {
        name,
        inputs: all,
        pre,
        scene,
    })
}

/// A number as the scene language writes it: without an exponent.
fn literal(value: f64) -> String {
    let text = format!("{}", value.abs());
    let point = if text.contains('.') { "" } else { ".0" };
    match value < 0.0 {
        true => format!("(-{text}{point})"),
        false => format!("{text}{point}"),
    }
}

/// What stands before the value: names are the core's, each bound once.
#[derive(Default)]
struct Says {
    lets: String,
    count: usize,
}

impl Says {
    /// An expression as the scene language has it, names being known as such.
    fn value(&mut self, form: &Form, known: &[(String, String)]) -> Result<String, String> {
        match form {
            Form::Word(word) => self::word(word, known),
            Form::List(parts) => match parts.as_slice() {
                [head, args @ ..] => self.applied(head.word(), args, known),
                [] => Err("nothing".to_owned()),
            },
        }
    }

    fn applied(
        &mut self,
        head: &str,
        args: &[Form],
        known: &[(String, String)],
    ) -> Result<String, String> {
        match (head, args) {
            ("let" | "let*", [bound, body]) => {
                let mut inner = known.to_vec();
                for pair in bound.list() {
                    let [name, value] = pair.list() else {
                        return Err("a let".to_owned());
                    };
                    let from = if head == "let" { known } else { &inner };
                    let made = self.value(value, from)?;
                    let as_name = format!("l{}", self.count);
                    self.count += 1;
                    self.lets += &format!("  let {as_name} = {made};\n");
                    inner.push((name.word().to_owned(), as_name));
                }
                return self.value(body, &inner);
            }
            // In which precision it is meant is not said: here each format is tried.
            ("!", [.., body]) | ("cast", [body]) => return self.value(body, known),
            _ => {}
        }
        if head.starts_with("while") || head.starts_with("for") {
            return Err("a loop".to_owned());
        }
        let made: Result<Vec<String>, String> =
            args.iter().map(|arg| self.value(arg, known)).collect();
        operation(head, &made?)
    }
}

fn word(word: &str, known: &[(String, String)]) -> Result<String, String> {
    if let Some((_, name)) = known.iter().rev().find(|(name, _)| name == word) {
        return Ok(name.clone());
    }
    match (word, number(word)) {
        ("PI", _) => Ok("pi".to_owned()),
        ("E", _) => Ok(literal(std::f64::consts::E)),
        (_, Some(value)) => Ok(literal(value)),
        _ => Err(format!("the name {word}")),
    }
}

fn operation(head: &str, args: &[String]) -> Result<String, String> {
    Ok(match (head, args) {
        ("-", [a]) => format!("(-{a})"),
        ("+" | "-" | "*" | "/" | "<" | "<=" | ">" | ">=" | "==", [a, b]) => {
            format!("({a} {head} {b})")
        }
        ("and" | "or", [a, b]) => format!("({a} {head} {b})"),
        ("not", [a]) => format!("(not {a})"),
        ("if", [c, a, b]) => format!("(if {c} then {a} else {b})"),
        ("sqrt" | "exp" | "log", [a]) => format!("{head}({a})"),
        ("sin" | "cos" | "tan", [a]) => format!("{head}({a} * 1rad)"),
        ("asin" | "acos", [a]) => format!("({head}({a}) / 1rad)"),
        ("atan", [a]) => format!("(atan2({a}, 1.0) / 1rad)"),
        ("atan2", [a, b]) => format!("(atan2({a}, {b}) / 1rad)"),
        ("fabs", [a]) => format!("abs({a})"),
        ("fmin", [a, b]) => format!("min({a}, {b})"),
        ("fmax", [a, b]) => format!("max({a}, {b})"),
        ("pow", [a, b]) => format!("({a} ^ {b})"),
        _ => return Err(format!("the operation {head}")),
    })
}
