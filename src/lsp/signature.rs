//! The heads of what is being called, with the parameter that is being written.

use super::describe::{builtin_head, told};
use super::look::At;
use super::scan;
use lsp_types::{ParameterInformation, ParameterLabel, SignatureHelp, SignatureInformation};
use slowlight_compiler::sema::signatures;

/// Of the call around a place.
pub fn help(at: At<'_>) -> Option<SignatureHelp> {
    let around = scan::around(at.text, at.byte);
    if around.quoted {
        return None;
    }
    let call = scan::call(at.text, &around)?;
    let names = at.of.names();
    let argument = call.argument + usize::from(call.method);
    let own = names.items(call.name, false).into_iter();
    let own = own.filter(|k| names.defs.get(*k).is_some_and(|d| d.kind.callable()));
    let own = own.filter_map(|k| {
        let parts = names
            .parts(k)
            .iter()
            .filter_map(|part| Some(told(at.of, *part)?.head));
        Some((told(at.of, k)?.head, parts.collect::<Vec<String>>()))
    });
    let ways = signatures();
    let ways = ways.iter().filter(|s| s.name == call.name);
    let builtin = ways.map(|s| {
        let params = s.params.iter().map(|p| p.0.to_owned());
        (builtin_head(at.of, s), params.collect::<Vec<String>>())
    });
    let all: Vec<(String, Vec<String>)> = own.chain(builtin).collect();
    if all.is_empty() {
        return None;
    }
    // The first that has room for the argument.
    let fits = all.iter().position(|(_, params)| params.len() > argument);
    let active = u32::try_from(argument).ok();
    let signature = |(head, params): (String, Vec<String>)| SignatureInformation {
        label: head,
        documentation: None,
        parameters: Some(params.into_iter().map(parameter).collect()),
        active_parameter: active,
    };
    Some(SignatureHelp {
        signatures: all.into_iter().map(signature).collect(),
        active_signature: u32::try_from(fits.unwrap_or(0)).ok(),
        active_parameter: active,
    })
}

fn parameter(label: String) -> ParameterInformation {
    ParameterInformation {
        label: ParameterLabel::Simple(label),
        documentation: None,
    }
}
