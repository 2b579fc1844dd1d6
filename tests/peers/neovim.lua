-- Opens a scene in Neovim as it is set up, and writes what comes of it to a file, as JSON: what
-- each name is coloured as, the answers of the language server, and its diagnostics of a wrong
-- line. Run by `nvim --headless -c "luafile tests/peers/neovim.lua"`.
local found = { colours = {} }
local WAIT = 30000

vim.cmd.edit(vim.env.SCENE)
found.filetype = vim.bo.filetype
local buffer = vim.api.nvim_get_current_buf()
found.highlighted = vim.treesitter.highlighter.active[buffer] ~= nil
local tree = vim.treesitter.get_parser(buffer):parse()[1]
found.errors = tree:root():has_error()
local query = vim.treesitter.query.get("slowlight", "highlights")
for _, node in query:iter_captures(tree:root(), buffer) do
  local text = vim.treesitter.get_node_text(node, buffer)
  local row, column = node:start()
  local all = vim.treesitter.get_captures_at_pos(buffer, row, column)
  -- What is captured last is what is seen.
  if #all > 0 and not text:find("\n") then found.colours[text] = all[#all].capture end
end

local function client() return vim.lsp.get_clients({ bufnr = buffer })[1] end
found.attached = vim.wait(WAIT, function() return client() and client().initialized end, 20)

for row, line in ipairs(vim.api.nvim_buf_get_lines(buffer, 0, -1, false)) do
  local column = line:find("demo%(mirrors")
  if column then vim.api.nvim_win_set_cursor(0, { row, column - 1 }) end
end
local params = vim.lsp.util.make_position_params(0, client().offset_encoding)
for _, answer in pairs(vim.lsp.buf_request_sync(buffer, "textDocument/hover", params, WAIT) or {}) do
  found.hover = answer.result and answer.result.contents.value
end
vim.wait(WAIT, function() return #vim.lsp.inlay_hint.get({ bufnr = buffer }) > 0 end, 20)
local hints = vim.lsp.inlay_hint.get({ bufnr = buffer })
found.hints = #hints
found.hint = hints[1] and hints[1].inlay_hint.label

vim.api.nvim_buf_set_lines(buffer, -1, -1, false, { "const wrong = nothing_such;" })
vim.wait(WAIT, function() return #vim.diagnostic.get(buffer) > 0 end, 20)
local wrong = vim.diagnostic.get(buffer)[1]
found.wrong = wrong and wrong.message
found.line = wrong and wrong.lnum + 1
found.lines = vim.api.nvim_buf_line_count(buffer)

local file = assert(io.open(vim.env.OUT, "w"))
file:write(vim.json.encode(found))
file:close()
vim.cmd("qa!")
