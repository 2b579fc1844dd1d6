//! S-expression reader: FPCore's text as lists and words.

/// A list, or a word.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    List(Vec<Form>),
    Word(String),
}

impl Form {
    /// The parts of a list; none of a word.
    pub fn list(&self) -> &[Form] {
        match self {
            Form::List(parts) => parts,
            Form::Word(_) => &[],
        }
    }

    /// The word, or nothing where it is a list.
    pub fn word(&self) -> &str {
        match self {
            Form::List(_) => "",
            Form::Word(word) => word,
        }
    }
}

/// All forms of a text. What is closed too often or never is taken as it is.
pub fn read(text: &str) -> Vec<Form> {
    let mut open: Vec<Vec<Form>> = vec![Vec::new()];
    for token in tokens(text) {
        match token.as_str() {
            "(" | "[" => open.push(Vec::new()),
            ")" | "]" if open.len() > 1 => {
                let done = open.pop().unwrap_or_default();
                put(&mut open, Form::List(done));
            }
            ")" | "]" => {}
            _ => put(&mut open, Form::Word(token)),
        }
    }
    open.swap_remove(0)
}

fn put(open: &mut [Vec<Form>], form: Form) {
    if let Some(last) = open.last_mut() {
        last.push(form);
    }
}

/// Brackets, strings with their first quote, and words; comments end with their line.
fn tokens(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        let mut token = String::from(c);
        match c {
            ';' => while rest.next_if(|c| *c != '\n').is_some() {},
            '"' => {
                token.extend(std::iter::from_fn(|| rest.next_if(|c| *c != '"')));
                rest.next();
                found.push(token);
            }
            '(' | ')' | '[' | ']' => found.push(token),
            c if c.is_whitespace() => {}
            _ => {
                let ends = |c: &char| c.is_whitespace() || "()[];\"".contains(*c);
                token.extend(std::iter::from_fn(|| rest.next_if(|c| !ends(c))));
                found.push(token);
            }
        }
    }
    found
}
