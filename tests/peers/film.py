#!/usr/bin/env python3
"""Makes a small animated GIF of the frames that record.mjs took; needs Pillow.

    film.py FOLDER OUT.gif

All frames share a palette without dither, so that what stands still costs nothing.
"""
import pathlib
import sys

from PIL import Image

WIDTH, COLOURS = 825, 80
# What stands still is shown no longer than this, in ms, unless a frame says so.
LONGEST = 1200


def main(folder, out):
    paths = sorted(pathlib.Path(folder).glob("*.png"))
    frames = []
    for path in paths:
        with Image.open(path) as image:
            size = (WIDTH, round(image.height * WIDTH / image.width))
            frames.append(image.convert("RGB").resize(size, Image.Resampling.LANCZOS))
    # The palette of frames from all over.
    chosen = frames[:: max(1, len(frames) // 8)]
    sheet = Image.new("RGB", (WIDTH, sum(f.height for f in chosen)))
    for k, frame in enumerate(chosen):
        sheet.paste(frame, (0, k * frame.height))
    palette = sheet.quantize(COLOURS, dither=Image.Dither.NONE)
    film, times = [], []
    for path, frame in zip(paths, frames):
        frame = frame.quantize(palette=palette, dither=Image.Dither.NONE)
        time = int(path.stem.split("-")[1])
        if film and frame.tobytes() == film[-1].tobytes():
            times[-1] = max(time, min(LONGEST, times[-1] + time))
        else:
            film.append(frame)
            times.append(time)
    film[0].save(out, save_all=True, append_images=film[1:], duration=times, loop=0, optimize=True)
    size = pathlib.Path(out).stat().st_size
    print(f"{out}: {len(film)} frames, {sum(times) / 1000:.1f} s, {size} bytes")


main(*sys.argv[1:])
