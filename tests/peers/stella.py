"""Shows a cartridge on Stella, without a display, and prints what is on its screen.

    python3 stella.py FOLDER CARTRIDGE TYPE

FOLDER is for what Stella writes. Prints a line of text for each line of the screen: the 160
pixels' colours, red, green and blue in hex. The picture must be a still one: it is read when
it has been the same twice.
"""
import os
import struct
import subprocess
import sys
import tempfile
import time

folder, cartridge, kind = sys.argv[1:4]
ZOOM = 2
OPTIONS = """-video software -audio.enabled 0 -tia.correct_aspect 0 -tia.inter 0
 -tia.vsizeadjust 0 -uimessages 0 -plr.detectedinfo 0 -plr.stats 0 -plr.tv.jitter 0
 -plr.colorloss 0 -tv.filter 0 -windowedpos 0x0 -center 0 -confirmexit 0""".split()


def screen(path):
    """The rows of a dump of the whole screen, four bytes a pixel."""
    data = open(path, "rb").read()
    header = struct.unpack(">25I", data[:100])
    width, height, row = header[4], header[5], header[12]
    begin = header[0] + header[19] * 12
    rows = (data[begin + y * row : begin + y * row + 4 * width] for y in range(height))
    return list(rows)


def ended(process):
    process.terminate()
    try:
        process.wait(10)
    except subprocess.TimeoutExpired:
        process.kill()


with tempfile.TemporaryDirectory(dir=folder) as own:
    reads, writes = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writes), "-screen", "0", "800x800x24", "-fbdir", own],
        pass_fds=[writes], stderr=subprocess.DEVNULL)
    os.close(writes)
    display = os.read(reads, 20).decode().strip()
    environment = dict(os.environ, DISPLAY=":" + display, XDG_RUNTIME_DIR=own)
    stella = subprocess.Popen(
        ["stella", "-basedir", own, "-userdir", own, "-tia.zoom", str(ZOOM), "-type", kind,
         *OPTIONS, cartridge],
        env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        before, rows = None, None
        end = time.monotonic() + 20
        while time.monotonic() < end:
            time.sleep(0.7)
            before, rows = rows, screen(os.path.join(own, "Xvfb_screen0"))
            if rows == before and any(any(row) for row in rows):
                break
        else:
            sys.exit("no still picture within 20 seconds")
    finally:
        ended(stella)
        ended(server)
for row in rows[::ZOOM]:
    # Four bytes a dot, and two dots of Stella's a pixel.
    places = range(0, 160 * 8 * ZOOM, 8 * ZOOM)
    pixels = (row[at : at + 3] for at in places)
    print("".join("%02x%02x%02x" % (p[2], p[1], p[0]) for p in pixels))
