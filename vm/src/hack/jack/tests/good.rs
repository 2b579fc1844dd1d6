//! Every construct, with its VM code.

use super::{compiled, shown, snapshot};

#[test]
fn arithmetic_goes_from_left_to_right() {
    let text = "class Main {
    function int main(int a, int b) {
        var boolean c;
        var char d;
        let a = 2 + 3 * 4 - a / b;
        let a = 2 + (3 * (4 - a));
        let c = (a < b) & (a > 0) | ~(a = b);
        let d = -32767 - 1;
        let a = ~-~a;
        let c = true;
        let c = false;
        return null;
    }
}";
    snapshot("arithmetic", &shown(&[("Main.jack", text)]));
}

#[test]
fn branches_and_loops() {
    let text = "class Main {
    function int sign(int a) {
        while (a > 100) {
            let a = a - 1;
            if (a = 50) { let a = 7; }
            while (false) { }
        }
        if (a < 0) {
            return -1;
        } else {
            if (a > 0) { return 1; } else { return 0; }
        }
    }
    function void after() {
        if (true) { } else { do Main.after(); }
        return;
    }
}";
    snapshot("flow", &shown(&[("Main.jack", text)]));
}

#[test]
fn arrays_nest() {
    let text = "class Main {
    static Array kept;
    function void main() {
        var Array a, b;
        var int i, j;
        let a = Array.new(10);
        let a[i] = a[j];
        let a[b[i]] = b[a[j]] + 1;
        let kept[a[0] + i] = Math.max(a[1], kept[kept[2]]);
        let i = a[i + 1];
        do a.dispose();
        return;
    }
}";
    snapshot("arrays", &shown(&[("Main.jack", text)]));
}

#[test]
fn objects_fields_and_statics() {
    let list = "/** A list of numbers. */
class List {
    field int head; field List tail;
    static int made, freed;

    constructor List new(int first, List rest) {
        let head = first;
        let tail = rest;
        let made = made + 1;
        return this;
    }
    method int sum() {
        var int local;
        if (tail = null) { return head; }
        let local = tail.sum();
        return head + local + count(this, made);
    }
    method int count(List other, int unused) { return other.head(); }
    method int head() { return head; }
    method void dispose() {
        if (~(tail = null)) { do tail.dispose(); }
        let freed = freed + 1;
        do Memory.deAlloc(this);
        do done();
        return;
    }
    method void done() { return; }
}";
    let main = "class Main {
    static int own;
    function void main() {
        var List list; // of two
        let list = List.new(1, List.new(2, null));
        do Output.printInt(list.sum());
        do list.dispose();
        return;
    }
}";
    let files = [("List.jack", list), ("folder/Main.jack", main)];
    snapshot("objects", &shown(&files));
}

#[test]
fn strings_and_empty_objects() {
    let text = r#"class Main {
    constructor Main new() { return this; }
    function String name() {
        do Output.printString("");
        do Output.printChar(String.doubleQuote());
        return "H /* i */ // ~";
    }
}"#;
    snapshot("strings", &shown(&[("Main.jack", text)]));
}

#[test]
fn inner_names_hide_outer_ones() {
    let text = "class Main {
    field int x, y;
    static int z;
    method int main(int y, Main Main) {
        var int z;
        let x = y + z;
        do Main.main(x, this);
        return x;
    }
    function int Math() { var Memory Screen; return 1; }
}";
    snapshot("scopes", &shown(&[("Main.jack", text)]));
}

#[test]
fn a_class_of_the_os_can_be_replaced() {
    let math = "class Math { function int multiply(int a, int b) { return a; } }";
    let main = "class Main { function int main() { return 2 * 3; } }";
    let files = [("Math.jack", math), ("Main.jack", main)];
    let compiled = compiled(&files).unwrap();
    assert!(compiled[1].text.contains("call Math.multiply 2"));
}

#[test]
fn layout_means_nothing() {
    let wide = "class Main { function int main ( int a ) { return a + ( - 1 ) ; } }";
    let narrow = "\u{feff}class/**/Main{//\r\nfunction\tint\r\nmain(int a){return a+(-1);}}/***/";
    let [wide, narrow] = [wide, narrow].map(|text| compiled(&[("Main.jack", text)]).unwrap());
    assert_eq!(wide[0].text, narrow[0].text);
    // But for where it is said to stand.
    assert_eq!((wide[0].lines[0], narrow[0].lines[0]), (1, 3));
}

#[test]
fn each_command_has_its_statements_line() {
    let text = "class Main {\n function int main(int a) {\n  while (a > 0) {\n   let a = a - 1;\n  }\n  return\n   a;\n }\n}";
    let compiled = compiled(&[("Main.jack", text)]).unwrap();
    let lines: Vec<String> = (compiled[0].text.lines().zip(&compiled[0].lines))
        .map(|(command, line)| format!("{line} {command}"))
        .collect();
    let expected = "2 function Main.main 0,3 label WHILE_EXP0,3 push argument 0,3 push constant 0,3 gt,\
        3 not,3 if-goto WHILE_END0,4 push argument 0,4 push constant 1,4 sub,4 pop argument 0,\
        3 goto WHILE_EXP0,3 label WHILE_END0,6 push argument 0,6 return";
    assert_eq!(lines.join(","), expected);
}

#[test]
fn no_files_are_no_program() {
    assert_eq!(compiled(&[]), Ok(Vec::new()));
}

#[test]
fn exactly_240_statics_fit() {
    let names = |count: usize| {
        let names: Vec<_> = (0..count).map(|i| format!("s{i}")).collect();
        format!("static int {};", names.join(", "))
    };
    let a = format!("class A {{ {} }}", names(200));
    let fits = format!("class B {{ {} }}", names(40));
    let compiled_sizes: Vec<_> = compiled(&[("A.jack", &a), ("B.jack", &fits)])
        .unwrap()
        .iter()
        .map(|file| file.statics)
        .collect();
    assert_eq!(compiled_sizes, [200, 40]);
    let over = format!("class B {{ {} }}", names(41));
    let faults = compiled(&[("A.jack", &a), ("B.jack", &over)]).unwrap_err();
    assert_eq!(faults.len(), 1);
    assert_eq!(faults[0].file.as_deref(), Some("B.jack"));
    let column = over.find("s40").unwrap() + 1;
    assert_eq!(faults[0].column, u32::try_from(column).ok());
}
