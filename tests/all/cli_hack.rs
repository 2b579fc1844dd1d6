//! The Hack computer on the command line: its VM and its processor, with the
//! operating system that a program brings, the native one, and ours.

use crate::cli::{directory, json, names, slowlight, success};
use crate::cli_run::SPOT;
use std::path::Path;

/// A product, a quotient, a root, lines and areas; without text, which only ours draws.
const DRAWS: &str = "class Main {
    function void main() {
        var Array points;
        var int k, x;
        let points = Array.new(40);
        while (k < 40) {
            let points[k] = ((k * 37) / 3) + Math.sqrt(k * 700);
            let k = k + 1;
        }
        let k = 1;
        while (k < 40) {
            do Screen.drawLine(points[k - 1] & 511, k * 5, points[k] & 511, (k * 6) & 255);
            let k = k + 1;
        }
        do Screen.drawCircle(300, 100, 60);
        do Screen.setColor(false);
        do Screen.drawRectangle(280, 80, Math.max(290, 310), 99);
        do Screen.drawPixel(Math.abs(-290), Math.min(120, 130));
        do points.dispose();
        return;
    }
}";

/// Puts 6 * 7 into RAM[0] and a word on the screen.
const ASSEMBLY: &str = "// a product by sums
    @6
    D=A
    @count
    M=D
(AGAIN)
    @7
    D=A
    @0
    M=D+M
    @count
    MD=M-1
    @AGAIN
    D;JGT
    @0
    D=M
    @SCREEN
    M=D
(END)
    @END
    0;JMP
";

fn program(dir: &Path, name: &str, text: &str) {
    std::fs::create_dir(dir.join(name)).expect("a directory");
    std::fs::write(dir.join(name).join("Main.jack"), text).expect("a file");
}

#[test]
fn a_program_draws_the_same_with_any_system_on_both_machines() {
    let dir = directory(&[]);
    let dir = dir.path();
    program(dir, "draws", DRAWS);
    let native = json(dir, &["vm", "jack", "draws", "--json"]);
    let ours = json(dir, &["vm", "jack", "draws", "--os", "jack", "--json"]);
    let cpu = json(dir, &["vm", "jack", "draws", "--cpu", "--json"]);
    assert_eq!(native["inks_sha256"], ours["inks_sha256"]);
    assert_eq!(native["inks_sha256"], cpu["inks_sha256"]);
    assert!(native["cycles"].as_u64() < ours["cycles"].as_u64());
    let words = cpu["rom_words"].as_u64().expect("words");
    assert!((200..8000).contains(&words), "{words}");
    assert!(ours.get("rom_words").is_none());
}

#[test]
fn a_scene_draws_the_same_from_the_rom() {
    let dir = directory(&[("spot.scn", SPOT)]);
    let dir = dir.path();
    for format in ["f316", "f316r", "log10", "fixed16", "f416"] {
        let run = |more: &[&str]| {
            let args = [
                "run", "spot.scn", "-t", "jack", "--json", "--format", format,
            ];
            json(dir, &[&args[..], more].concat())
        };
        let native = run(&[]);
        let rom = run(&["--os", "jack"]);
        assert_eq!(rom["inks_sha256"], native["inks_sha256"], "{format}");
        assert_eq!(rom["differs_from_model"], 0);
        let count = |of: &serde_json::Value, key: &str| of[key].as_u64().expect("a number");
        assert!(count(&rom, "cycles") > count(&rom, "vm_instructions"));
        assert_eq!(count(&native, "cycles"), count(&native, "vm_instructions"));
        assert!(native["rom_words"].is_null());
        assert!(count(&rom, "os_calls") > 0);
        assert_eq!(count(&rom, "code_bytes"), 2 * count(&rom, "rom_words"));
        // Edited, too, and with what `build` wrote of the system.
        let out = format!("out_{format}");
        let build = [
            "build", "spot.scn", "-t", "jack", "--os", "jack", "--format", format,
        ];
        success(dir, &[&build[..], &["-o", &out]].concat());
        let all = names(&dir.join(&out));
        for wanted in [
            "Main.jack",
            "Math.jack",
            "Sys.jack",
            "Main.hack",
            "Main.asm",
        ] {
            assert!(all.iter().any(|name| name == wanted), "{wanted}: {all:?}");
        }
        let again = run(&["--os", "jack", "--program", &out]);
        assert_eq!(again["inks_sha256"], native["inks_sha256"]);
        assert_eq!(again["rom_words"], rom["rom_words"], "{format}");
        // What was written is whole: on the VM no function is the VM's own, and the
        // image and the assembly are the program.
        let digest =
            |args: &[&str]| json(dir, &[args, &["--json"]].concat())["inks_sha256"].clone();
        let vm = digest(&["vm", "jack", &out]);
        for file in ["Main.hack", "Main.asm"] {
            assert_eq!(
                digest(&["vm", "hack", &format!("{out}/{file}")]),
                vm,
                "{file}"
            );
        }
    }
}

#[test]
fn machine_code_runs_as_assembly_and_as_an_image() {
    let dir = directory(&[("six.asm", ASSEMBLY)]);
    let dir = dir.path();
    let said = json(
        dir,
        &[
            "vm", "hack", "six.asm", "--image", "six.hack", "--json", "-o", "six.pbm",
        ],
    );
    assert_eq!(said["stopped"], "ended");
    assert_eq!(said["rom_words"], 18);
    assert_eq!(said["cycles"], 4 + 6 * 8 + 4);
    let image = std::fs::read_to_string(dir.join("six.hack")).expect("an image");
    assert_eq!(image.lines().count(), 18);
    assert_eq!(image.lines().next(), Some("0000000000000110"));
    // 42 is 101010: pixels 1, 3 and 5.
    let drawn = std::fs::read(dir.join("six.pbm")).expect("a picture");
    assert_eq!(drawn[11], 0b0101_0100);
    let again = json(dir, &["vm", "hack", "six.hack", "--json"]);
    for key in ["cycles", "inks_sha256", "rom_words"] {
        assert_eq!(again[key], said[key]);
    }
}

#[test]
fn a_program_is_translated_to_an_image_and_to_assembly() {
    let dir = directory(&[]);
    let dir = dir.path();
    program(dir, "draws", DRAWS);
    let run = |image: &str| {
        json(
            dir,
            &["vm", "jack", "draws", "--cpu", "--image", image, "--json"],
        )
    };
    let (image, assembly) = (run("draws.hack"), run("draws.asm"));
    assert_eq!(image, assembly);
    for file in ["draws.hack", "draws.asm"] {
        assert_eq!(json(dir, &["vm", "hack", file, "--json"]), image, "{file}");
    }
    // VM code takes what it lacks as Jack does.
    let code = "function Main.main 0\npush constant 3\npush constant 4\n\
        call Screen.drawPixel 2\npop temp 0\npush constant 0\nreturn\n";
    std::fs::write(dir.join("Main.vm"), code).expect("a file");
    let native = json(dir, &["vm", "hack", "Main.vm", "--json"]);
    for more in [&["--cpu"][..], &["--os", "jack"]] {
        let ours = json(dir, &[&["vm", "hack", "Main.vm", "--json"], more].concat());
        assert_eq!(ours["inks_sha256"], native["inks_sha256"], "{more:?}");
    }
}

/// What a program brings itself stays its own.
#[test]
fn a_program_may_bring_a_part_of_the_system() {
    let main = "class Main { function void main() {
        do Screen.drawPixel(10, 10); do Memory.poke(16384, Math.multiply(3, 5)); return; } }";
    let math = "class Math {
        static int times;
        function void init() { let times = 100; return; }
        function int multiply(int a, int b) { return times + a + b; }
    }";
    let dir = directory(&[]);
    let dir = dir.path();
    program(dir, "own", main);
    std::fs::write(dir.join("own/Math.jack"), math).expect("a file");
    for more in [&[][..], &["--os", "jack"], &["--cpu"]] {
        success(
            dir,
            &[&["vm", "jack", "own", "-o", "own.pbm"], more].concat(),
        );
        let drawn = std::fs::read(dir.join("own.pbm")).expect("a picture");
        // 108 is 01101100, and its lowest bit stands on the left.
        assert_eq!(drawn[11], 0b0011_0110, "{more:?}");
        assert_eq!(drawn[11 + 640 + 1], 0b0010_0000, "{more:?}");
    }
}

/// Errors end a run with the same number everywhere.
#[test]
fn errors_are_reported() {
    let dir = directory(&[]);
    let dir = dir.path();
    let main = "class Main { function void main() {
        var int zero; do Screen.drawPixel(5 / zero, 1); return; } }";
    program(dir, "fails", main);
    for more in [&[][..], &["--os", "jack"], &["--cpu"]] {
        let output = slowlight(dir, &[&["vm", "jack", "fails", "--json"], more].concat());
        assert_eq!(output.status.code(), Some(1), "{more:?}");
        let said: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(said["stopped"], "fault");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(message.contains("Sys.error(3)"), "{more:?}: {message}");
    }
}

#[test]
fn what_does_not_fit_the_rom_is_not_written() {
    // Spheres that hang on a param in ways of their own are code each.
    let balls = (0..60).map(|k| format!("sphere(({k}, {k} * size, 1), 0.2 + {k} * size) is 1;"));
    let balls: String = balls.collect();
    let text = format!(
        "image 24 x 16 inks black, white; param size: real = 0.1 in 0 .. 1; scene s {{ {balls} }}
         draw (x, y) = ink(if let h = s.trace(pinhole((0, 0, 9), at: (0, 0, 0), field: 40deg)
           .through(x, y), far: 90) then (if h.normal.y > 0 then 1 else 0) else 0);"
    );
    let dir = directory(&[("large.scn", &text)]);
    let (scene, dir) = ("large.scn", dir.path());
    let run = |command: &str, more: &[&str]| {
        let args = [command, scene, "-t", "jack", "--format", "f316", "--os"];
        slowlight(dir, &[&args[..], more].concat())
    };
    let output = run("build", &["jack"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in [
        "does not fit the Hack",
        "more than the ROM's 32768 words",
        "what would help",
    ] {
        assert!(said.contains(part), "{said}");
    }
    assert_eq!(names(dir), ["large.scn"], "nothing is written");
    assert_eq!(run("build", &["native"]).status.code(), Some(0));
}

#[test]
fn wrong_uses() {
    let dir = directory(&[
        ("spot.scn", SPOT),
        ("a.asm", ASSEMBLY),
        ("b.asm", ASSEMBLY),
        ("p.bas", "10 END\n"),
    ]);
    let dir = dir.path();
    program(dir, "draws", DRAWS);
    for (args, status, part) in [
        (
            &["vm", "jack", "draws", "--cpu", "--os", "native"][..],
            2,
            "the VM's",
        ),
        (
            &["vm", "bbc", "p.bas", "--os", "jack"],
            2,
            "the Hack computer's",
        ),
        (&["vm", "bbc", "p.bas", "--cpu"], 2, "the Hack computer's"),
        (&["vm", "hack", "a.asm", "b.asm"], 2, "one file"),
        (&["vm", "jack", "draws", "--image", "x.hack"], 2, "--image"),
        (
            &["run", "spot.scn", "-t", "6502", "--os", "jack"],
            2,
            "--os is Jack's",
        ),
        (
            &["run", "spot.scn", "-t", "jack", "--os", "unix"],
            2,
            "possible values",
        ),
    ] {
        let output = slowlight(dir, args);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(status), "{args:?}: {said}");
        assert!(said.contains(part), "{args:?}: {said}");
    }
    std::fs::write(dir.join("bad.asm"), "@1\nD=Q\n").expect("a file");
    let output = slowlight(dir, &["vm", "hack", "bad.asm"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        String::from_utf8_lossy(&output.stderr).contains("2"),
        "the line"
    );
    std::fs::write(dir.join("bad.hack"), "0101\n").expect("a file");
    assert_eq!(
        slowlight(dir, &["vm", "hack", "bad.hack"]).status.code(),
        Some(1)
    );
}

/// A picture whose rows of errors fill the heap: the system's font must find room beside
/// them, or it is said before anything is written.
#[test]
fn the_systems_part_of_the_heap_counts() {
    let scene = |width: u32| {
        format!(
            "image {width} x 2 inks black, white;
            dither floyd(v: real, x: int, y: int) -> ink = {{
              let q = clamp(round(v * (inks - 1)), 0, inks - 1);
              spread v - q / (inks - 1) to {{ (1, 0): 7/16, (-1, 1): 3/16, (0, 1): 5/16, (1, 1): 1/16 }};
              ink(q)
            }};
            draw (x, y) = floyd(x / {width}, x, y);"
        )
    };
    let (fits, large) = (scene(1150), scene(1178));
    let dir = directory(&[("fits.scn", &fits), ("large.scn", &large)]);
    let dir = dir.path();
    let run = ["run", "-t", "jack", "--format", "f316", "--json", "--os"];
    for (name, system) in [("fits.scn", "jack"), ("large.scn", "native")] {
        let found = json(dir, &[&run[..], &[system, name]].concat());
        assert_eq!(found["differs_from_model"], 0, "{name}");
    }
    let output = slowlight(dir, &[&run[..], &["jack", "large.scn"]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in ["words of heap", "operating system 287", "--os native"] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

/// What the official tools take is taken, with a warning, on the VM and on the processor;
/// a call that goes nowhere ends the program that comes to it.
#[test]
fn what_is_taken_with_a_warning() {
    let class = |condition: &str| {
        format!(
            "class Main {{ function void main() {{ var Nobody n; if ({condition}) {{ do Ghost.haunt(); \
             do Memory.free(5); }} do Output.printInt(7); return; }} }}"
        )
    };
    let dir = directory(&[("Add.vm", "push constant 20\npush constant 3\nsub\n")]);
    let dir = dir.path();
    for (name, condition) in [("never", "1 = 2"), ("comes", "2 = 2")] {
        program(dir, name, &class(condition));
        for more in [&[][..], &["--cpu"]] {
            let output = slowlight(dir, &[&["vm", "jack", name][..], more].concat());
            let said = String::from_utf8_lossy(&output.stderr);
            for warned in [
                "no class `Nobody`",
                "no class `Ghost`",
                "no subroutine `free`",
            ] {
                assert!(said.contains(warned), "{said}");
            }
            let status = i32::from(name == "comes");
            assert_eq!(output.status.code(), Some(status), "{said}");
            if more.is_empty() && status == 0 {
                assert_eq!(output.stdout, b"7");
            }
            let error = match more.is_empty() {
                true => "there is no function Ghost.haunt",
                false => "the program calls a function that it lacks",
            };
            assert_eq!(said.contains(error), status == 1, "{said}");
        }
    }
    assert_eq!(success(dir, &["vm", "hack", "Add.vm"]), "stack: 17\n");
    let output = slowlight(dir, &["vm", "hack", "--cpu", "Add.vm"]);
    assert_eq!(output.status.code(), Some(2));
}
