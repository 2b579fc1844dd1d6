//! The compiler's tests, by what they ask.
#![allow(clippy::unwrap_used)]

mod good;
mod hard;
mod run;
mod wrong;

use super::{VmFile, compile_warning};
use crate::Fault;

/// Compiles files given as name and text.
fn compiled(files: &[(&str, &str)]) -> Result<Vec<VmFile>, Vec<Fault>> {
    warned(files).0
}

/// The same, and what is warned of.
fn warned(files: &[(&str, &str)]) -> (Result<Vec<VmFile>, Vec<Fault>>, Vec<Fault>) {
    let mut warnings = Vec::new();
    let files: Vec<_> = files
        .iter()
        .map(|(name, text)| (name.to_string(), text.to_string()))
        .collect();
    (compile_warning(&files, &mut warnings), warnings)
}

/// A program and what became of it, VM code or faults.
fn shown(files: &[(&str, &str)]) -> String {
    let mut out = String::new();
    for (name, text) in files {
        out += &format!("== {name}\n{}\n", text.trim_end());
    }
    match compiled(files) {
        Ok(compiled) => {
            for file in compiled {
                out += &format!("-- {} ({} statics)\n{}", file.name, file.statics, file.text);
            }
        }
        Err(faults) => {
            for fault in faults {
                out += &format!("-- {fault}\n");
            }
        }
    }
    out
}

/// Compares with the file of that name; `INSTA_UPDATE=always` rewrites it.
fn snapshot(name: &str, text: &str) {
    insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
        insta::assert_snapshot!(name, text);
    });
}
