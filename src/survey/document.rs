//! The document: Markdown, with a plot a section.

use super::Survey;
use super::section::Section;
use crate::format::count;
use slowlight_compiler::targets::Target;

/// The text; `own` is the command that wrote it, and `pictures` the way from it to the plots.
pub fn document(asked: &Survey, sections: &[Section], own: &str, pictures: &str) -> String {
    let mut out = format!(
        "# What accuracy costs in time: a survey\n\
         Written by `{own}` (slowlight {}, on {} {}, {} processors; figures are of the bundled \
         machines, and no host changes them).\n\n{INTRODUCTION}\n\n{}",
        env!("CARGO_PKG_VERSION"),
        std::env::consts::OS,
        std::env::consts::ARCH,
        std::thread::available_parallelism().map_or(1, usize::from),
        machines(&asked.targets),
    );
    out.push_str(&summary(asked, sections));
    let mut before = None;
    for section in sections {
        if before != Some(&section.path) {
            let path = section.path.display();
            out.push_str(&format!("\n## {}\nThe scene is `{path}`.\n", section.scene));
        }
        before = Some(&section.path);
        out.push_str(&part(section, pictures));
    }
    out
}

const INTRODUCTION: &str = "\
Each scene is tuned on each machine, as `slowlight tune` does it: formats of numbers, params \
folded or not, blocks, fewer turns of loops, other ways to find hits, normals and samples. The \
frontier is what no other way beats in both time and error; errors are against the scene as it is \
written, in `f64` and in the same inks. Each row is a whole picture that was run, held against its \
model in every pixel; `slowlight run SCENE --target T` and the row's options give its figures \
again, to the cycle and the pixel. *program* is the beginning of the SHA-256 of the program's \
files, by which the tests see whether this page is still true.";

/// What a machine's time is.
fn machines(targets: &[&'static Target]) -> String {
    let mut out = "| machine | cycles a second | |\n|---|---:|---|\n".to_owned();
    for target in targets {
        let (name, hertz, about) = (target.name, count(target.hertz as u64), target.about);
        out.push_str(&format!("| {name} | {hertz} | {about} |\n"));
    }
    out
}

fn summary(asked: &Survey, sections: &[Section]) -> String {
    let caption = asked.measure.caption();
    let mut out = format!(
        "\nErrors in this table: {caption}. *knee*: where accuracy becomes dear; *factor*: from the \
         quickest time to that of the best; *order*: rank correlation (Spearman) of the times that \
         the planner predicts with the measured ones, along the frontier.\n\n\
         | scene | machine | quickest | knee | best | factor | worth choosing | order |\n\
         |---|---|---:|---:|---:|---:|---:|---:|\n"
    );
    for section in sections {
        let cells = section.summary.join(" | ");
        out.push_str(&format!(
            "| {} | {} | {cells} |\n",
            section.scene, section.target
        ));
    }
    out
}

fn part(section: &Section, pictures: &str) -> String {
    let (scene, target) = (&section.scene, &section.target);
    let mut out = format!(
        "\n### {scene} on {target}\n`{}`\n\n{}\n\n![{scene} on {target}: time against error]({pictures}{})\n\n",
        section.command,
        section.sentence,
        section.picture()
    );
    let line = |row: &Vec<String>| format!("| {} |\n", row.join(" | "));
    for (k, row) in section.rows.iter().enumerate() {
        out.push_str(&line(row));
        if k == 0 {
            let rule = (0..row.len()).map(|k| if k == 0 { "---" } else { "---:" });
            out.push_str(&format!("|{}|\n", rule.collect::<Vec<_>>().join("|")));
        }
    }
    for note in &section.notes {
        // A cell or a mark of Markdown in it would be read as such.
        out.push_str(&format!("\n{}\n", note.replace('|', "\\|")));
    }
    out
}
