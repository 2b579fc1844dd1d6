#!/usr/bin/env python3
"""How long `slowlight lsp` works on an edit: each scene is edited 200 times at places all over
it, and after each edit asked for its diagnostics, which makes it look closely at once. Edits that
others follow within a moment take less, as only the last of them is looked at closely.

    editors/latency.py target/release/slowlight examples/*.scn
"""
import json
import pathlib
import subprocess
import sys
import time

EDITS = 200


class Server:
    def __init__(self, program):
        pipe = subprocess.PIPE
        self.process = subprocess.Popen([program, "lsp"], stdin=pipe, stdout=pipe)
        self.asked = 0

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def tell(self, method, params):
        self.send({"method": method, "params": params})

    def read(self):
        length = 0
        while line := self.process.stdout.readline().strip():
            name, value = line.split(b":")
            length = int(value) if name.lower() == b"content-length" else length
        return json.loads(self.process.stdout.read(length))

    def ask(self, method, params):
        self.asked += 1
        self.send({"id": self.asked, "method": method, "params": params})
        while (message := self.read()).get("id") != self.asked or "method" in message:
            pass
        return message


def times(server, path):
    text = path.read_text()
    of = {"uri": path.resolve().as_uri()}
    opened = {**of, "languageId": "slowlight", "version": 0, "text": text}
    server.tell("textDocument/didOpen", {"textDocument": opened})
    server.ask("textDocument/documentSymbol", {"textDocument": of})
    lines = text.split("\n")
    found = []
    for k in range(EDITS):
        line = k // 2 * 7 % len(lines)
        # A comment comes and goes: what is edited can be read before and after.
        end = len(lines[line])
        at = {"line": line, "character": end}
        to = {"line": line, "character": end + (4 if k % 2 else 0)}
        change = [{"range": {"start": at, "end": to}, "text": "" if k % 2 else "// a"}]
        begun = time.perf_counter()
        version = {**of, "version": k + 1}
        server.tell("textDocument/didChange", {"textDocument": version, "contentChanges": change})
        server.ask("textDocument/diagnostic", {"textDocument": of})
        found.append(1000 * (time.perf_counter() - begun))
    server.tell("textDocument/didClose", {"textDocument": of})
    return sorted(found)


def main():
    program, *scenes = sys.argv[1:]
    server = Server(program)
    server.ask("initialize", {"capabilities": {}})
    server.tell("initialized", {})
    print("scene, bytes, ms an edit: median, 95 of 100, most")
    for path in map(pathlib.Path, scenes):
        all_times = times(server, path)
        some = [all_times[int(EDITS * share)] for share in (0.5, 0.95)] + [all_times[-1]]
        print(path.name, path.stat().st_size, *(f"{one:.1f}" for one in some))
    server.ask("shutdown", None)
    server.tell("exit", None)
    sys.exit(server.process.wait())


if __name__ == "__main__":
    main()
