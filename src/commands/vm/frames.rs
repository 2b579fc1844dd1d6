//! `vm 6502:vcs`: a machine whose programs never end, and are run for so many frames.

use super::{Args, Kind};
use crate::failure::{Failure, Outcome};
use crate::moving::film::FilmFile;
use crate::picture::Picture;
use slowlight_vm::keys::{Keyboard, Unit};

/// Frames that are shown, unless the user says otherwise.
const FRAMES: u64 = 60;

/// The most frames of a film: all are kept.
const FILM: u64 = 3_000;

/// Cycles that a frame takes at most, on an average, for the run to come to its end: three of
/// PAL's.
const FRAME: u64 = 3 * 312 * 76;

/// Pictures a second: a GIF's delays are hundredths, and below two viewers take their own time, so
/// NTSC's sixty cannot be had.
const RATE: u16 = 50;

/// Where all frames go: of the VCS, where `-o` names a GIF.
///
/// # Errors
/// Where it cannot be written.
pub(super) fn film(args: &Args) -> Outcome<Option<FilmFile<'_>>> {
    let named = args.output.as_deref();
    let gif = named
        .and_then(|path| path.extension())
        .is_some_and(|e| e.eq_ignore_ascii_case("gif"));
    match args.machine == Kind::MosVcs && gif {
        true => Ok(Some(FilmFile::named(named)?)),
        false => Ok(None),
    }
}

/// The joystick, whose script ends the run, and the cycles at which it is stopped where it
/// does not come to that.
///
/// # Errors
/// What is wrong with the script, and more frames than a film may have.
pub(super) fn keyboard(args: &Args, filmed: bool) -> Outcome<(Keyboard, u64)> {
    let script = args.keys.script()?;
    let own = match script.quits() {
        true => script.length(),
        false => script.length().max(FRAMES),
    };
    let frames = args.frames.map_or(own, u64::from);
    if filmed && frames > FILM {
        return Err(Failure::Usage(format!(
            "a film of {frames} frames: at most {FILM} are kept"
        )));
    }
    if filmed && script.pictures().next().is_some() {
        let message = "a film has every frame, so there is no `shot` in its script";
        return Err(Failure::Usage(message.to_owned()));
    }
    let limit = args
        .limit
        .min(frames.saturating_add(10).saturating_mul(FRAME));
    let script = match filmed {
        // The first look is at the first frame's beginning, when there is none yet.
        true => script.filmed(frames + 1),
        false => script.ended(frames),
    };
    Ok((Keyboard::new(script, Unit::Frames, |_| None), limit))
}

/// Writes the film of the frames that the run came to.
///
/// # Errors
/// Where it cannot be written, or there was none.
pub(super) fn write(film: &FilmFile<'_>, keyboard: &Keyboard) -> Outcome<()> {
    let shown = keyboard
        .shots()
        .iter()
        .filter_map(|(_, screen)| screen.as_ref());
    let pictures: Vec<Picture> = shown.map(Picture::from).collect();
    if pictures.is_empty() {
        return Err(Failure::Wrong("the program showed no picture".to_owned()));
    }
    film.write(&pictures, RATE)
}
