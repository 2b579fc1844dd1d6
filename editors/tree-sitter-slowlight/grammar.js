/// The grammar of Slowlight's scene language for tree-sitter; docs/language.md says what it
/// means, and the compiler's parser (compiler/syntax/src/parser) is what it is held against.
/// <reference types="tree-sitter-cli/dsl" />

// From loosest to tightest.
const PREC = {
  choice: 0,
  or: 1,
  and: 2,
  not: 3,
  compare: 4,
  sum: 5,
  product: 6,
  minus: 7,
  power: 8,
  postfix: 9,
};

const comma = (rule) => seq(rule, repeat(seq(",", rule)));

module.exports = grammar({
  name: "slowlight",

  extras: ($) => [/\s/, $.comment],

  word: ($) => $.identifier,

  supertypes: ($) => [$._expression, $._item],

  rules: {
    source_file: ($) => repeat($._item),

    comment: () => token(seq("//", /[^\n]*/)),

    _item: ($) =>
      choice(
        $.image,
        $.param,
        $.state,
        $.const,
        $.function,
        $.effect,
        $.shape,
        $.scene,
        $.record,
        $.map,
        $.dither,
        $.draw,
        $.use,
      ),

    image: ($) =>
      seq(
        "image",
        field("width", $._expression),
        "x",
        field("height", $._expression),
        "inks",
        comma(choice($.ink, $.colour)),
        ";",
      ),

    ink: ($) => $._name,

    colour: () => /#[0-9A-Za-z_]*/,

    param: ($) =>
      seq(
        "param",
        field("name", $._name),
        ":",
        field("type", $._type),
        "=",
        field("value", $._expression),
        optional(seq("in", field("low", $._expression), "..", field("high", $._expression))),
        ";",
      ),

    state: ($) =>
      seq(
        "state",
        field("name", $._name),
        ":",
        field("type", $._type),
        "=",
        field("value", $._expression),
        optional(seq("in", field("low", $._expression), "..", field("high", $._expression))),
        "->",
        field("next", $._expression),
        ";",
      ),

    const: ($) => seq("const", field("name", $._name), $._body),

    function: ($) => seq("fn", $._head, $._body),

    dither: ($) => seq("dither", $._head, $._body),

    effect: ($) => seq("effect", $._head, "else", field("otherwise", $._expression), $._body),

    _head: ($) =>
      seq(
        field("name", $._name),
        field("parameters", $.parameters),
        "->",
        field("result", $._type),
      ),

    _body: ($) => seq("=", field("body", $._expression), ";"),

    parameters: ($) => seq("(", optional(comma($.parameter)), ")"),

    parameter: ($) =>
      seq(
        field("name", $._name),
        ":",
        field("type", $._type),
        optional(seq("=", field("default", $._expression))),
      ),

    shape: ($) =>
      seq(
        "shape",
        field("name", $._name),
        field("parameters", $.parameters),
        "{",
        repeat($.facet),
        "}",
      ),

    facet: ($) =>
      seq(
        field("name", $._name),
        optional(seq("(", field("argument", $._name), ")")),
        $._body,
      ),

    scene: ($) => seq("scene", field("name", $._name), $._members),

    _members: ($) => seq("{", repeat(choice($.member, $.members)), "}"),

    member: ($) =>
      seq(field("shape", $._expression), optional(seq("is", field("tag", $._expression))), ";"),

    members: ($) => seq($._counter, $._members),

    _counter: ($) =>
      seq(
        "each",
        field("counter", $._name),
        "in",
        field("low", $._expression),
        "..",
        field("high", $._expression),
      ),

    record: ($) => seq("record", field("name", $._name), "{", comma($.field), "}"),

    field: ($) => seq(field("name", $._name), ":", field("type", $._type)),

    map: ($) =>
      seq("map", field("name", $._name), "{", repeat1($.string), "}", "where", comma($.cell), ";"),

    cell: ($) => seq($.character, "=>", $._expression),

    draw: ($) =>
      seq("draw", "(", field("column", $._name), ",", field("row", $._name), ")", $._body),

    use: ($) => seq("use", field("path", $.string), ";"),

    _type: ($) => choice($.type, $.table_type, $.function_type, $.optional_type),

    type: ($) => choice($._name, "shape", "scene", "map"),

    table_type: ($) => seq("[", $._type, "]"),

    function_type: ($) =>
      prec.right(seq("fn", "(", optional(comma($._type)), ")", "->", $._type)),

    optional_type: ($) => prec(1, seq($._type, "?")),

    _expression: ($) =>
      choice(
        $.name,
        $.integer,
        $.real,
        $.angle,
        $.boolean,
        $.none,
        $.tuple,
        $.table,
        $.unary,
        $.binary,
        $.call,
        $.method,
        $.part,
        $.index,
        $.condition,
        $.loop,
        $.each,
        $.next,
        $.block,
      ),

    name: ($) => $._name,

    call: ($) => seq(field("function", $._name), field("arguments", $.arguments)),

    each: ($) =>
      seq(
        field("function", $._name),
        optional(field("arguments", $.arguments)),
        $._counter,
        field("body", $.block),
      ),

    method: ($) =>
      prec(
        PREC.postfix,
        seq($._expression, ".", field("function", $._name), field("arguments", $.arguments)),
      ),

    part: ($) => prec(PREC.postfix, seq($._expression, ".", field("name", $._name))),

    index: ($) => prec(PREC.postfix, seq($._expression, "[", comma($._expression), "]")),

    arguments: ($) => seq("(", optional(comma($.argument)), ")"),

    argument: ($) => seq(optional(seq(field("name", $._name), ":")), $._expression),

    // One in brackets is that one.
    tuple: ($) => seq("(", comma($._expression), ")"),

    table: ($) =>
      seq("[", comma($._expression), repeat(seq(";", comma($._expression))), "]"),

    unary: ($) =>
      choice(
        prec(PREC.minus, seq(field("operator", "-"), $._expression)),
        prec(PREC.not, seq(field("operator", "not"), $._expression)),
      ),

    binary: ($) =>
      choice(
        ...[
          [PREC.or, "or"],
          [PREC.and, "and"],
          [PREC.compare, choice("==", "!=", "<", "<=", ">", ">=")],
          [PREC.sum, choice("+", "-")],
          [PREC.product, choice("*", "/", "mod", "div")],
        ].map(([level, operator]) =>
          prec.left(level, seq($._expression, field("operator", operator), $._expression)),
        ),
        prec.right(PREC.power, seq($._expression, field("operator", "^"), $._expression)),
      ),

    condition: ($) =>
      prec.right(
        PREC.choice,
        seq(
          "if",
          optional(seq("let", field("binding", $._name), "=")),
          field("condition", $._expression),
          "then",
          field("yes", $._expression),
          "else",
          field("no", $._expression),
        ),
      ),

    loop: ($) =>
      prec.right(
        PREC.choice,
        seq(
          "loop",
          "(",
          comma($.carried),
          ")",
          "max",
          field("max", $._expression),
          field("body", $.block),
          "else",
          field("otherwise", $._expression),
        ),
      ),

    carried: ($) => seq(field("name", $._name), "=", field("value", $._expression)),

    next: ($) => seq("next", "(", comma($._expression), ")"),

    block: ($) => seq("{", repeat(choice($.let, $.spread)), field("result", $._expression), "}"),

    let: ($) =>
      seq(optional($.claim), "let", field("name", $._name), "=", field("value", $._expression), ";"),

    claim: () => choice("frame", "row", "column"),

    spread: ($) => seq("spread", $._expression, "to", "{", comma($.share), "}", ";"),

    share: ($) => seq(field("offset", $._expression), ":", field("weight", $._expression)),

    boolean: () => choice("true", "false"),

    none: () => "none",

    integer: () => /[0-9]+/,

    real: () => /[0-9]+\.[0-9]+/,

    angle: () => /[0-9]+(\.[0-9]+)?(deg|turn|rad)/,

    string: () => /"[^"\n]*"/,

    character: () => /'[^\n\r]'/,

    // Words that mean something in one place only are names in all others.
    _name: ($) =>
      choice($.identifier, alias(choice("frame", "row", "column"), $.identifier)),

    identifier: () => /[A-Za-z_][A-Za-z0-9_]*/,
  },
});
