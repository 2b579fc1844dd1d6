//! Drawing and text on graphics screens, held against what the genuine OS 1.20 answered.

use super::{Dialect, ink, run, run_on};
use crate::Stop;

/// What the program printed last, in MODE 7.
fn answer(program: &str) -> String {
    let run = run(&format!("10{program}"));
    assert_eq!(run.stop, Stop::Ended, "{program}");
    run.text.trim_end().lines().last().unwrap().to_owned()
}

/// Each prints what OS 1.20 printed.
fn answers(list: &[(&str, &str)]) {
    for (program, expected) in list {
        let program = format!("{program}:VDU 22,7:PRINT:PRINT;A;\" \";B;\" \";C;\" \";D");
        let program = format!("A=-9:B=-9:C=-9:D=-9:{program}");
        assert_eq!(answer(&program), *expected, "{program}");
    }
}

#[test]
fn triangles_have_the_edges_that_the_operating_system_steps() {
    answers(&[
        (
            "MODE 1:MOVE 0,0:MOVE 4,16:PLOT 85,16,8:A=POINT(0,8):CLG:MOVE 0,0:MOVE 16,64:\
             PLOT 85,0,64:B=POINT(4,8):CLG:MOVE 0,0:MOVE 0,0:PLOT 85,1279,0:C=POINT(640,0)",
            "3 0 0 -9",
        ),
        (
            "MODE 5:MOVE 0,0:MOVE 40,1000:PLOT 85,1272,500:A=0:\
             FOR I%=0 TO 1272 STEP 8:A=A-(POINT(I%,600)>0):NEXT",
            "126 -9 -9 -9",
        ),
        // All in one row: of three corners only two count.
        (
            "MODE 0:MOVE 100,100:MOVE 900,100:PLOT 85,300,100:\
             A=POINT(100,100):B=POINT(600,100):C=POINT(900,100)",
            "1 1 1 -9",
        ),
        // Two halves of a square that share their edge: drawn twice, exclusive OR leaves nothing.
        (
            "MODE 2:GCOL 3,5:MOVE 0,0:MOVE 600,0:PLOT 85,0,600:PLOT 85,600,600:A=0:\
             FOR I%=0 TO 600 STEP 8:A=A-(POINT(I%,600-I%)=5):NEXT",
            "0 -9 -9 -9",
        ),
    ]);
}

#[test]
fn plots_groups_of_codes() {
    answers(&[
        (
            "MODE 1:MOVE 0,500:PLOT 13,40,500:A=POINT(40,500):CLG:MOVE 0,500:PLOT 37,40,500:\
             B=POINT(20,500):CLG:MOVE 0,0:PLOT 21,1279,1023:PLOT 29,0,1023:C=POINT(0,1023):\
             D=POINT(4,1023)",
            "3 0 3 0",
        ),
        // Inverted, the last point comes back.
        (
            "MODE 1:MOVE 0,500:PLOT 14,40,500:A=POINT(40,500):B=POINT(36,500)",
            "0 3 -9 -9",
        ),
        // 45 draws nothing and moves only what relative coordinates are added to.
        (
            "MODE 4:MOVE 0,0:PLOT 45,400,0:PLOT 1,100,0:A=POINT(450,0):B=POINT(50,0):\
             PLOT 1,0,100:C=POINT(500,50)",
            "1 1 0 -9",
        ),
        // 117 moves the cursor, but not the place before it.
        (
            "MODE 1:MOVE 0,0:PLOT 117,400,0:PLOT 5,400,400:A=POINT(400,200):B=POINT(200,200):\
             PLOT 5,0,400:C=POINT(200,400)",
            "3 0 3 -9",
        ),
    ]);
}

#[test]
fn rows_are_filled_up_to_another_ink() {
    answers(&[
        (
            "MODE 1:MOVE 400,0:DRAW 400,1020:MOVE 800,0:DRAW 800,1020:GCOL 0,2:PLOT 77,600,500:\
             A=POINT(404,500):B=POINT(796,500):C=POINT(800,500):GCOL 0,1:PLOT 1,0,100:\
             D=POINT(796,550)",
            "2 2 3 1",
        ),
        (
            "MODE 1:MOVE 400,0:PLOT 77,0,0:GCOL 0,1:PLOT 77,100,0:PLOT 1,100,100:A=POINT(200,100)",
            "1 -9 -9 -9",
        ),
        (
            "MODE 1:GCOL 0,2:MOVE 100,100:DRAW 300,100:GCOL 0,1:PLOT 93,200,100:\
             A=POINT(196,100):B=POINT(200,100):C=POINT(300,100):D=POINT(304,100)",
            "2 1 1 0",
        ),
    ]);
}

#[test]
fn windows_origins_and_points_move_the_cursor_as_they_do_there() {
    answers(&[
        // POINT's place is what the next relative coordinates are added to.
        (
            "MODE 1:MOVE 100,100:A=POINT(400,400):PLOT 1,100,0:B=POINT(200,100):PLOT 69,0,0:\
             MOVE 100,100:A=POINT(400,400):PLOT 65,100,0:C=POINT(500,400):D=POINT(200,100):A=0",
            "0 0 3 0",
        ),
        // A new origin leaves the cursor at a whole pixel.
        (
            "MODE 5:MOVE 5,5:VDU 29,100;100;:PLOT 65,107,100:A=POINT(0,0):B=POINT(8,0):\
             C=POINT(7,4)",
            "0 0 3 -9",
        ),
        (
            "MODE 1:VDU 24,400;400;300;500;:A=POINT(0,0):VDU 24,300;400;500;500;:B=POINT(0,0):\
             VDU 24,0;0;1280;1023;:C=POINT(400,400):D=POINT(0,0)",
            "0 -1 0 -1",
        ),
        // CLG with an action.
        (
            "MODE 1:GCOL 1,129:GCOL 0,2:PLOT 69,0,0:CLG:A=POINT(0,0):B=POINT(4,0):\
             GCOL 4,128:CLG:C=POINT(0,0):D=POINT(4,0)",
            "3 1 0 2",
        ),
    ]);
}

#[test]
fn characters_are_drawn_at_either_cursor() {
    answers(&[
        (
            "MODE 4:VDU 23,240,255,129,129,129,129,129,129,255:PRINT CHR$240:A=POINT(0,1023):\
             B=POINT(4,1019):VDU 5:MOVE 640,512:VDU 240:C=POINT(640,512):D=POINT(644,508):VDU 4",
            "1 0 1 0",
        ),
        (
            "MODE 2:VDU 23,225,128;0;0;0;:COLOUR 131:COLOUR 6:VDU 31,3,2,225:\
             A=POINT(192,956):B=POINT(200,956)",
            "6 3 -9 -9",
        ),
        // Shapes share a page: 200 is 232, and with a letter defined 200 has what was there.
        (
            "MODE 1:VDU 23,200,255;0;0;0;:VDU 31,0,5,232:A=POINT(0,863):VDU 23,65,1;0;0;0;:\
             VDU 31,1,6,65:B=POINT(60,831):VDU 23,96,1,2,3,4,5,6,7,8:\
             VDU 23,224,9,9,9,9,9,9,9,9:C=?&C00:D=?&C01",
            "3 3 9 9",
        ),
        // Scrolled two rows, memory and all.
        (
            "MODE 5:GCOL 0,2:PLOT 69,0,0:FOR I%=1 TO 33:PRINT:NEXT:A=POINT(0,64):B=POINT(0,0):\
             ?&5800=&F0:C=0:FOR Y%=0 TO 1020 STEP 4:C=C+Y%*(POINT(0,Y%)=2):NEXT",
            "2 0 -124 -9",
        ),
        (
            "MODE 4:VDU 28,5,20,30,10:A=POS+VPOS:VDU 31,26,0:B=POS+VPOS:VDU 31,25,10,9:\
             C=POS*10+VPOS:VDU 26:D=POS+VPOS",
            "0 0 10 0",
        ),
    ]);
    let shared = "MODE 4:VDU 23,240,255,129,129,129,129,129,129,255\n20PRINT CHR$240:VDU 5:\
                  MOVE 640,512:VDU 240\n30VDU 4:IF POINT(0,1023)=1 AND POINT(640,512)=1 \
                  PRINT \"drawn\" ELSE PRINT \"not drawn\"";
    assert_eq!(answer(shared), "drawn");
}

#[test]
fn a_screen_that_is_off_shows_nothing() {
    let run = run("10MODE 1:VDU 21:PRINT\"NO\":VDU 6:PRINT\"YES\":VDU 21:PLOT 69,0,0:VDU 6");
    assert_eq!(run.text, "YES\n");
    assert_eq!(ink(&run, 0, 255), 0);
}

#[test]
fn a_letter_is_legible_and_a_deleted_one_gone() {
    let run = run("10MODE 4:PRINT\"O\":VDU 31,1,0,35,127");
    let set = |x: u32, y: u32| usize::from(ink(&run, x, y) == 1);
    let count = |left: u32| -> usize {
        (0..8)
            .flat_map(|y| (0..8).map(move |x| (x, y)))
            .map(|(x, y)| set(left + x, y))
            .sum()
    };
    assert!((12..40).contains(&count(0)), "{}", count(0));
    // Its middle is open.
    assert_eq!(set(3, 3), 0);
    assert_eq!(count(8), 0);
}

#[test]
fn later_machines_leave_out_ends_of_lines() {
    let run = run_on(
        Dialect::BasicV,
        "10MODE 9:GCOL 0,15:MOVE 0,0:PLOT 45,40,0:MOVE 0,40:PLOT 37,40,40",
    );
    let row = |y: u32| (0..12).map(|x| ink(&run, x, y)).collect::<Vec<_>>();
    assert_eq!(row(255), [0, 15, 15, 15, 15, 15, 15, 15, 15, 15, 0, 0]);
    assert_eq!(row(245), [0, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 0]);
}
