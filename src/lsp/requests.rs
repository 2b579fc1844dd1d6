//! The requests of an editor, one after the other, each of what is known now.

use super::complete::complete;
use super::look::{definition, highlights, hover, references};
use super::outline::{formatted, symbols};
use super::rename::{prepare, rename};
use super::signature;
use super::state::State;
use lsp_server::{ErrorCode, Request, ResponseError};
use lsp_types::request::{self as asked, Request as Asked};
use lsp_types::{
    CompletionResponse, DocumentSymbolResponse, GotoDefinitionResponse, OneOf,
    OptionalVersionedTextDocumentIdentifier, TextDocumentEdit, TextDocumentPositionParams,
    TextEdit, Uri, WorkspaceEdit,
};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// What a request comes to.
pub type Answer = Result<Value, ResponseError>;

/// What a request is answered where it cannot be done, and why.
pub fn refused(code: ErrorCode, message: impl Into<String>) -> ResponseError {
    ResponseError {
        code: code as i32,
        message: message.into(),
        data: None,
    }
}

/// A value for the editor.
pub fn value(found: impl Serialize) -> Answer {
    serde_json::to_value(found).map_err(|e| refused(ErrorCode::InternalError, e.to_string()))
}

/// Reads what a request asks.
///
/// # Errors
/// Where it is not what the protocol says.
pub fn params<R: Asked>(request: &Request) -> Result<R::Params, ResponseError> {
    R::Params::deserialize(&request.params)
        .map_err(|e| refused(ErrorCode::InvalidParams, e.to_string()))
}

/// Answers a request about a text; none where it is about something else.
pub fn answer(state: &State, request: &Request) -> Option<Answer> {
    Some(match request.method.as_str() {
        asked::HoverRequest::METHOD => params::<asked::HoverRequest>(request)
            .and_then(|p| value(at(state, &p.text_document_position_params).and_then(hover))),
        asked::GotoDefinition::METHOD => params::<asked::GotoDefinition>(request).and_then(|p| {
            let found = at(state, &p.text_document_position_params).map(definition);
            value(found.map(GotoDefinitionResponse::Array))
        }),
        asked::References::METHOD => params::<asked::References>(request).and_then(|p| {
            let declared = p.context.include_declaration;
            value(at(state, &p.text_document_position).map(|at| references(at, declared)))
        }),
        asked::DocumentHighlightRequest::METHOD => {
            params::<asked::DocumentHighlightRequest>(request)
                .and_then(|p| value(at(state, &p.text_document_position_params).map(highlights)))
        }
        asked::Completion::METHOD => params::<asked::Completion>(request).and_then(|p| {
            let at = at(state, &p.text_document_position);
            let found = at.filter(|at| !is_library(at)).map(|at| {
                let remake = |text| state.remake(at.of, &[(at.file, text)]);
                CompletionResponse::Array(complete(at, &remake))
            });
            value(found)
        }),
        asked::SignatureHelpRequest::METHOD => params::<asked::SignatureHelpRequest>(request)
            .and_then(|p| {
                value(at(state, &p.text_document_position_params).and_then(signature::help))
            }),
        asked::PrepareRenameRequest::METHOD => params::<asked::PrepareRenameRequest>(request)
            .and_then(|p| match at(state, &p) {
                Some(at) => prepare(at)
                    .map_err(|why| refused(ErrorCode::InvalidParams, why))
                    .and_then(value),
                None => Ok(Value::Null),
            }),
        asked::Rename::METHOD => params::<asked::Rename>(request).and_then(|p| {
            let Some(at) = at(state, &p.text_document_position) else {
                return Ok(Value::Null);
            };
            let remake = |texts: &[(u16, String)]| state.remake(at.of, texts);
            let edits = rename(at, &p.new_name, &remake)
                .map_err(|why| refused(ErrorCode::InvalidParams, why))?;
            if let Some(other) = state.other_user(at.of, &edits, &p.new_name) {
                let why = format!(
                    "{} has that name, or the new one, too: open it alone, or rename there by hand",
                    other.as_str()
                );
                return Err(refused(ErrorCode::InvalidParams, why));
            }
            value(workspace_edit(state, edits))
        }),
        asked::DocumentSymbolRequest::METHOD => params::<asked::DocumentSymbolRequest>(request)
            .and_then(|p| {
                let found = tree(state, &p.text_document.uri);
                value(found.map(|(file, text)| DocumentSymbolResponse::Nested(symbols(file, text))))
            }),
        asked::Formatting::METHOD => params::<asked::Formatting>(request).and_then(|p| {
            let document = state.documents.get(p.text_document.uri.as_str());
            value(document.map(|d| Vec::from_iter(formatted(&d.text))))
        }),
        _ => return None,
    })
}

fn at<'s>(state: &'s State, of: &TextDocumentPositionParams) -> Option<super::look::At<'s>> {
    state.at(&of.text_document.uri, of.position)
}

fn is_library(at: &super::look::At<'_>) -> bool {
    at.of
        .files()
        .get(usize::from(at.file))
        .is_none_or(|f| f.library)
}

fn tree<'s>(
    state: &'s State,
    uri: &Uri,
) -> Option<(&'s slowlight_compiler::syntax::tree::File, &'s str)> {
    let known = state.known(uri)?;
    let (file, text) = known.file(uri)?;
    let (tree, _) = known.whole.trees.get(usize::from(file))?;
    Some((tree, text))
}

/// Edits of texts, each of the version that is known.
fn workspace_edit(state: &State, edits: Vec<(Uri, Vec<TextEdit>)>) -> WorkspaceEdit {
    let edit = |(uri, edits): (Uri, Vec<TextEdit>)| TextDocumentEdit {
        text_document: OptionalVersionedTextDocumentIdentifier {
            version: state.documents.get(uri.as_str()).map(|d| d.version),
            uri,
        },
        edits: edits.into_iter().map(OneOf::Left).collect(),
    };
    WorkspaceEdit {
        document_changes: Some(lsp_types::DocumentChanges::Edits(
            edits.into_iter().map(edit).collect(),
        )),
        ..WorkspaceEdit::default()
    }
}
