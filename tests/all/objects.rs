//! Many objects: what they cost beside one, wherever rays come from.

use crate::cli::{directory, json};

/// Balls in a spiral over a floor: seen by these rays, with a lamp's shadows.
fn balls(count: u32, rays: &str) -> String {
    let ball = |k: u32| {
        let (turn, out) = (2.4 * f64::from(k), 0.5 * f64::from(k).sqrt());
        let [x, z] = [out * turn.cos(), out * turn.sin() - 1.0];
        let high = 0.3 + 0.12 * f64::from(k % 9);
        format!(
            "  sphere(({x:.2}, {high:.2}, {z:.2}), 0.2) is {:.1};\n",
            0.4 + 0.1 * f64::from(k % 6)
        )
    };
    let all: String = (0..count).map(ball).collect();
    format!(
        "image 64 x 48 inks black, #555555, #aaaaaa, white;
        scene world {{
          plane((0, 1, 0), 0) is checker(p.xz, 0.8, 0.4);
        {all}}}
        const lamp = (4, 7, 5);
        fn shade(r: ray) -> real = if let h = world.trace(r, far: 20)
          then h.tag * (0.2 + 0.8 * lambert(h, unit(lamp - h.point)) * hard_shadow(world, h, lamp)) else 0.1;
        draw (x, y) = {{
          let v = {rays};
          threshold(v, bayer(4)[x mod 4, y mod 4])
        }};"
    )
}

/// What six rows in the middle take, without what the program does before.
fn cycles(scene: &str, target: &str, options: &[&str]) -> f64 {
    let dir = directory(&[("scene.scn", scene)]);
    let run = |rows: &str| {
        let mut args = vec![
            "run",
            "scene.scn",
            "-t",
            target,
            "--format",
            "log10",
            "--json",
        ];
        args.extend(["--rows", rows]);
        args.extend(options);
        let said = json(dir.path(), &args);
        assert_eq!(said["differs_from_model"], 0, "{target}:\n{scene}");
        said["cycles"].as_f64().expect("cycles are a number")
    };
    run("24..30") - run("24..24")
}

/// Sixty balls take less than four times what one does.
fn holds(rays: &str) {
    for target in ["jack", "6502:plain"] {
        let [one, many] = [1, 60].map(|count| cycles(&balls(count, rays), target, &[]));
        let times = many / one;
        assert!(times < 4.0, "{target}: {many} for {one}, {times:.2}");
    }
}

const CAMERA: &str = "pinhole((0, 2, 6), at: (0, 0.6, 0), field: 50deg).through(x, y)";

#[test]
fn sixty_balls_take_less_than_four_times_what_one_does() {
    holds(&format!("shade({CAMERA})"));
}

#[test]
fn the_first_ray_of_a_loop_is_as_quick() {
    let followed = format!(
        "loop (r = {CAMERA}, left = 1.0) max 3 {{
            if let h = world.trace(r, far: 20)
            then (if h.tag > 0.85 then next(mirror(r, h), 0.8 * left) else left * h.tag)
            else left * sky_gradient(r.dir)
          }} else 0"
    );
    holds(&followed);
}

#[test]
fn parallel_rays_ask_few_of_them() {
    let scene = balls(
        60,
        "shade(ray(((x - 32) / 14, (48 - y) / 14, 6), (0, 0, -1)))",
    );
    for target in ["jack", "6502:plain"] {
        let [all, few] = [&["--without-pass", "bounds"][..], &[]];
        let [all, few] = [all, few].map(|options| cycles(&scene, target, options));
        assert!(few < 0.25 * all, "{target}: {few} for {all}");
    }
}
