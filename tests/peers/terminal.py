"""A terminal that says what it is: runs a command in a pseudo-terminal, answers the question for
its primary device attributes, and writes all else that it was sent to standard output.

    python3 terminal.py ANSWER COMMAND ...

ANSWER stands behind `ESC [ ?`: `62;4c` has sixels; empty, nothing is answered."""

import os
import pty
import select
import sys
import time

LIMIT = 30
answer, command = sys.argv[1], sys.argv[2:]
child, terminal = pty.fork()
if child == 0:
    os.execvp(command[0], command)
end = time.monotonic() + LIMIT
seen = b""
while time.monotonic() < end:
    if not select.select([terminal], [], [], 1)[0]:
        continue
    try:
        more = os.read(terminal, 65536)
    except OSError:
        break
    if not more:
        break
    if b"\x1b[c" in more:
        more = more.replace(b"\x1b[c", b"")
        if answer:
            os.write(terminal, b"\x1b[?" + answer.encode())
    seen += more
_, status = os.waitpid(child, 0)
sys.stdout.buffer.write(seen)
sys.exit(os.waitstatus_to_exitcode(status))
