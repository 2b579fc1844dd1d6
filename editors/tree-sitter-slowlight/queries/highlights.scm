; Captures that Neovim and Helix both know; what stands last wins.

(identifier) @variable

(comment) @comment
(string) @string
(character) @character
(colour) @string.special
(integer) @number
(real) @number
(angle) @number
(boolean) @boolean
(none) @constant.builtin

[
  "image" "param" "state" "const" "fn" "effect" "shape" "scene" "record" "map" "dither" "draw" "use"
  "let" "loop" "next" "spread" "each" "is" "in" "where" "inks" "x" "max" "to"
] @keyword

["if" "then" "else"] @keyword
["and" "or" "not" "div" "mod"] @keyword.operator
(claim) @keyword

[
  "->" "=>" "==" "!=" "<" "<=" ">" ">=" "=" "+" "-" "*" "/" "^" ".." "?"
] @operator

["(" ")" "[" "]" "{" "}"] @punctuation.bracket
["," ";" ":" "."] @punctuation.delimiter

(type) @type
(type (identifier) @type)
(ink) @constant
(ink (identifier) @constant)

(param name: (identifier) @variable)
(const name: (identifier) @constant)
(map name: (identifier) @constant)
(function name: (identifier) @function)
(effect name: (identifier) @function)
(dither name: (identifier) @function)
(shape name: (identifier) @type)
(scene name: (identifier) @type)
(record name: (identifier) @type)
(facet name: (identifier) @function)

(parameter name: (identifier) @variable.parameter)
(argument name: (identifier) @variable.parameter)
(field name: (identifier) @property)
(part name: (identifier) @property)

(call function: (identifier) @function)
(method function: (identifier) @function)
(each function: (identifier) @function)
