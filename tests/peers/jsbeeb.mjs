// Runs programs on a BBC Micro with the genuine OS 1.20 and BASIC II: a driver for jsbeeb.
//
//   node jsbeeb.mjs PATH-OF-THE-PACKAGE JOBS.json
//
// JOBS.json is a list of jobs; the answer, a list of results, goes to standard output as JSON.
// A job has one of
//   "tokenised": hex   bytes to stand at PAGE, then RUN
//   "typed": text      lines for BASIC's own line editor and tokeniser, then RUN
//   "disc": hex        an .ssd image, booted with SHIFT held
//   "programs": list   small programs, each [text, lines for its INPUTs], run one after the other
// and may have
//   "page"             PAGE, &1900 unless told (a number)
//   "limit"            cycles of 2 MHz to stop after, 4e9 unless told
//   "dump": [a, b]     memory to hand back, from a up to b
//   "begin"            the address from which on cycles are counted, once the processor is there
//   "press": true      presses SPACE where the program waits for a key, and goes on to BASIC's
//                      prompt: "back" in the result says whether it came there
//   "quiet": true      no interrupts while the program runs
//   "tell": n          says on standard error how far it is, each n cycles
//   "cases"            see below
// or, in place of all that,
//   "drawings"         see below
//
// A result has
//   "stopped"          "prompt" (BASIC wants a line) or "limit"
//   "cycles"           from the program's start to its end
//   "marks"            [number, cycles since the start] for each write to &70
//   "text"             what was written to the screen, control codes included
//   "memory"           the dump, hex
//   "video"            what the screen's hardware was told last: "registers" of the 6845, "control"
//                      and "palette" of the video ULA, colours by patterns
//   "cases"            see below
//   "drawings"         see below
// of "programs" only
//   "texts"            what each wrote, with the lines that it was given where it read them
//   "tokens"           what each was stored as, hex
//
// Lines go in where BASIC asks the operating system for one (OSWORD 0), as if they had been
// typed very quickly. A mark is the program's own `?&70=n`.
//
// "cases": many small calculations without a program's overhead. Each is a list of
// [address, hex] to be written when the program says ?&70=1; when it says ?&70=2 the bytes
// "read": [address, count] are taken, and the cycles since the 1; when it says ?&70=3 (from
// ON ERROR) the byte at &71 is taken as an error's number. The answer has a [hex, cycles] a
// case, or [error number, 0].
//
// "drawings": many small pictures. Each is a list of bytes (hex) that go one by one to the
// operating system's OSWRCH, without interrupts; the answer has for each the SHA-256 of the
// screen's inks, a byte each by rows from the top left, as the screen lies in memory then, and
// the cycles. With "inks": true the inks themselves, hex, stand in the digest's place.

import path from "node:path";
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const root = path.resolve(process.argv[2]);
const load = (file) => import(pathToFileURL(path.join(root, file)).href);
// The emulator tells what it loads; standard output is for results alone.
console.log = (...words) => console.error(...words);
const { TestMachine } = await load("tests/test-machine.js");
const { setNodeBasePath } = await load("src/utils.js");
setNodeBasePath(root);

const MARK = 0x70;
const SECOND = 2_000_000;
const SHIFT = 16;
const SPACE = 32;
/** OS 1.20: where it waits for a key, and the file that stands for the keyboard, if any. */
const WAIT_FOR_KEY = 0xe581;
const EXEC_FILE = 0x256;
/** The keyboard's buffer: where it is read and written next; and how far a soft key has been read. */
const KEYS_OUT = 0x2d8;
const KEYS_IN = 0x2e1;
const SOFT_KEY_PLACE = 0x2c9;
/** OS 1.20's screen: its mode, where it starts, and the colours and pixels a byte less one. */
const MODE = 0x355;
const SCREEN_START = 0x350;
const TOP_INK = 0x360;
const LAST_PIXEL = 0x361;
const SCREEN_END = 0x8000;
/** Where the bytes of a drawing stand, and what hands them on: with the first address in &80 and
    the end in &82, LDY #0, LDA (&80),Y, JSR &FFEE, then INC of the address until it is the end,
    and a mark. */
const DRAWING = 0x1b00;
const HAND_ON = 0x1a00;
const HANDING_ON = "a000b18020eeffe680d002e681a580c582d0efa581c583d0e98570";
/** Cycles that a drawing may take. */
const DRAWN_BY = 4e8;
/** BASIC II: where it keeps the high byte of PAGE, and TOP. */
const PAGE = 0x18;
const TOP = 0x12;
/** BASIC II: the page into which INPUT has a line read; its own lines go to another. */
const INPUT_PAGE = 6;
/** Brings BASIC to what it is after a reset, as far as programs change it for those after them. */
const FRESH = [
  "NEW",
  "MODE7",
  "TRACE OFF:WIDTH0:CLOSE#0",
  "FORA=&404TO&46BSTEP4:!A=0:NEXT",
  "@%=&90A:A=RND(-1)",
  "CLEAR",
];
/** Cycles that a small program has. */
const SMALL = 10 * SECOND;
/** Cycles between two fields, and the length of the pulse between them (the CRTC's). */
const FIELD = 40_000;
const PULSE = 256;

const bytes = (hex) => Uint8Array.from(Buffer.from(hex, "hex"));

class Micro {
  async boot(job) {
    this.machine = new TestMachine("B-DFS1.2");
    await this.machine.initialise();
    this.cpu = this.machine.processor;
    this.fields();
    this.watch();
    this.marks = [];
    this.start = 0;
    this.cpu.debugInstruction.add((pc) => this.instruction(pc));
    this.cpu.debugWrite.add((address, value) => {
      if (address === MARK && this.running) this.mark(value);
    });
    if (job.disc) {
      this.machine.loadDiscData(bytes(job.disc));
      this.cpu.sysvia.keyDown(SHIFT);
      await this.machine.runFor(SECOND);
      this.cpu.sysvia.keyUp(SHIFT);
    }
  }

  /** The vertical sync interrupts of a screen that nobody looks at. */
  fields() {
    let high = false;
    const task = this.cpu.scheduler.newTask(() => {
      high = !high;
      this.cpu.sysvia.setVBlankInt(high ? 1 : 0);
      task.reschedule(high ? PULSE : FIELD - PULSE);
    });
    task.schedule(FIELD);
  }

  /** Notes what the screen's hardware is told: the 6845's registers, the video ULA's control and
      palette. */
  watch() {
    const seen = { registers: Array(18).fill(0), control: 0, palette: Array(16).fill(0) };
    let chosen = 0;
    this.cpu.video.crtc.write = (address, value) => {
      if (address & 1) seen.registers[chosen & 31] = value;
      else chosen = value;
    };
    this.cpu.video.ula.write = (address, value) => {
      if (address & 1) seen.palette[value >> 4] = (value & 15) ^ 7;
      else seen.control = value;
    };
    this.seen = seen;
  }

  now() {
    return this.cpu.cycleSeconds * SECOND + this.cpu.currentCycles;
  }

  byte(address) {
    return this.cpu.ramRomOs[address];
  }

  poke(address, list) {
    this.cpu.ramRomOs.set(list, address);
  }

  word(address) {
    return this.byte(address) | (this.byte(address + 1) << 8);
  }

  /** Before each instruction: notes characters, stops where BASIC wants a line. */
  instruction(pc) {
    if (pc === this.job.begin && this.running && !this.entered) {
      this.entered = true;
      this.start = this.now();
    }
    if (pc === this.word(0x20e)) this.text.push(this.cpu.a);
    // A disc's !BOOT file answers calls for lines itself, until it is at its end; it may leave a
    // soft key pressed.
    if (this.job.disc && !this.pressed) return pc === WAIT_FOR_KEY && this.byte(EXEC_FILE) === 0 && this.idle();
    return pc === this.word(0x20c) && this.cpu.a === 0;
  }

  /** No key is left, and of a soft key nothing more came since the last time. */
  idle() {
    const place = this.byte(SOFT_KEY_PLACE);
    const same = place === this.place;
    this.place = place;
    return same && this.byte(KEYS_OUT) === this.byte(KEYS_IN);
  }

  mark(value) {
    if (!this.job.cases) {
      this.marks.push([value, this.now() - this.start]);
      return;
    }
    const cases = this.job.cases;
    if (value === 1) {
      if (this.answers.length >= cases.length) return void this.cpu.stop();
      for (const [address, hex] of cases[this.answers.length]) this.poke(address, bytes(hex));
      this.begun = this.now();
    } else if (value === 2) {
      const [address, count] = this.job.read;
      const result = this.cpu.ramRomOs.subarray(address, address + count);
      this.answers.push([Buffer.from(result).toString("hex"), this.now() - this.begun]);
    } else if (value === 3) {
      this.answers.push([this.byte(0x71), 0]);
    }
  }

  /** Runs until BASIC wants a line (true), until the limit, or until the cases are over. */
  async run(limit) {
    const end = this.now() + limit;
    while (this.now() < end) {
      const went = this.cpu.execute(Math.min(1_000_000, end - this.now()));
      if (!went) return !this.over();
      this.tell();
    }
    return false;
  }

  tell() {
    if (!this.running || this.now() < this.told) return;
    this.told += this.job.tell;
    const million = Math.round((this.now() - this.start) / 1e6);
    console.error(`${million} million cycles on the ROM`);
  }

  over() {
    return this.job.cases && this.answers.length >= this.job.cases.length;
  }

  /** Answers the operating system's call for a line, and goes on after it. */
  line(text) {
    const cpu = this.cpu;
    const block = cpu.x | (cpu.y << 8);
    this.poke(this.word(block), Buffer.from(text + "\r", "latin1"));
    cpu.y = text.length;
    cpu.p.c = false;
    const at = 0x100 + ((cpu.s + 1) & 0xff);
    const back = this.word(at);
    cpu.s = (cpu.s + 2) & 0xff;
    cpu.pc = (back + 1) & 0xffff;
  }

  async type(lines) {
    for (const line of lines) {
      this.line(line);
      if (!(await this.run(10 * SECOND))) throw new Error(`no prompt after ${line}`);
    }
  }

  /** Runs small programs one after the other; answers what each wrote and was stored as. */
  async programs(list) {
    if (!(await this.run(SMALL))) throw new Error("no prompt");
    const texts = [];
    const tokens = [];
    for (const [text, input] of list) {
      await this.type([...FRESH, ...text.split("\n").filter((line) => line !== "")]);
      const stored = this.cpu.ramRomOs.subarray(this.byte(PAGE) << 8, this.word(TOP));
      tokens.push(Buffer.from(stored).toString("hex"));
      this.line("RUN");
      this.text.length = 0;
      const lines = [...input];
      while ((await this.run(SMALL)) && this.asks()) {
        const line = lines.shift() ?? "";
        // The operating system would have echoed it.
        this.text.push(...Buffer.from(line, "latin1"), 10, 13);
        this.line(line);
      }
      if (!this.here()) throw new Error(`no end of ${text}, which wrote ${Buffer.from(this.text).toString("latin1")}`);
      texts.push(Buffer.from(this.text).toString("latin1"));
    }
    return { texts, tokens };
  }

  /** Is the processor where a line is wanted? */
  here() {
    return this.cpu.pc === this.word(0x20c) && this.cpu.a === 0;
  }

  /** Is it INPUT that wants the line, rather than BASIC itself? */
  asks() {
    return this.here() && this.word(this.cpu.x | (this.cpu.y << 8)) >> 8 === INPUT_PAGE;
  }

  async load(job) {
    if (!(await this.run(10 * SECOND))) throw new Error("no prompt");
    await this.type([`PAGE=${job.page ?? 0x1900}`, "NEW"]);
    if (job.typed !== undefined) {
      await this.type(job.typed.split(/\r?\n/).filter((line) => line !== ""));
    } else {
      const program = bytes(job.tokenised);
      const page = job.page ?? 0x1900;
      this.poke(page, program);
      await this.type(["OLD"]);
    }
  }

  /** A picture's inks, a byte each. */
  inks() {
    const last = this.byte(LAST_PIXEL);
    const bits = 8 / (last + 1);
    const wide = this.byte(MODE) < 3;
    const row = wide ? 640 : 320;
    const size = 32 * row;
    const start = this.word(SCREEN_START) - (SCREEN_END - size);
    const width = (row / 8) * (last + 1);
    const list = new Uint8Array(width * 256);
    for (let y = 0; y < 256; y++) {
      for (let x = 0; x < width; x++) {
        const at = (y >> 3) * row + Math.floor(x / (last + 1)) * 8 + (y & 7);
        const byte = this.byte(SCREEN_END - size + ((start + at) % size)) << (x % (last + 1));
        let ink = 0;
        for (let b = 0; b < bits; b++) ink = (ink << 1) | ((byte >> (7 - b * (last + 1))) & 1);
        list[y * width + x] = ink & this.byte(TOP_INK);
      }
    }
    return list;
  }

  /** One drawing: its inks or their digest, and cycles. */
  async draw(hex) {
    const list = bytes(hex);
    this.poke(DRAWING, list);
    const end = DRAWING + list.length;
    this.poke(0x80, [DRAWING & 255, DRAWING >> 8, end & 255, end >> 8]);
    this.cpu.pc = HAND_ON;
    this.drawn = false;
    const start = this.now();
    await this.run(DRAWN_BY);
    if (!this.drawn) throw new Error(`a drawing without end: ${hex}`);
    const cycles = this.now() - start;
    const inks = this.inks();
    if (this.job.inks) return [Buffer.from(inks).toString("hex"), cycles];
    return [createHash("sha256").update(inks).digest("hex"), cycles];
  }

  async draws(job) {
    this.job = job;
    this.text = [];
    await this.boot(job);
    await this.load({ typed: "" });
    // A look at each instruction takes most of the time; the mark is all that is wanted now.
    this.cpu.debugInstruction.clear();
    this.cpu.debugWrite.clear();
    this.cpu.debugWrite.add((address) => {
      if (address !== MARK) return false;
      this.drawn = true;
      return true;
    });
    this.cpu.p.i = true;
    this.poke(HAND_ON, bytes(HANDING_ON));
    const drawings = [];
    for (const hex of job.drawings) drawings.push(await this.draw(hex));
    return { drawings };
  }

  async go(job) {
    if (job.drawings) return this.draws(job);
    this.job = job;
    this.text = [];
    this.answers = [];
    await this.boot(job);
    if (job.programs) return this.programs(job.programs);
    if (!job.disc) {
      await this.load(job);
      this.line("RUN");
    }
    if (job.quiet) this.cpu.p.i = true;
    this.text.length = 0;
    this.running = true;
    this.start = this.now();
    this.told = this.start + (this.job.tell ?? Infinity);
    const prompt = await this.run(job.limit ?? 4e9);
    const cycles = this.now() - this.start;
    const [from, to] = job.dump ?? [0, 0];
    const memory = Buffer.from(this.cpu.ramRomOs.subarray(from, to)).toString("hex");
    const video = structuredClone(this.seen);
    let back = false;
    if (job.press) {
      this.pressed = true;
      this.cpu.sysvia.keyDown(SPACE);
      back = await this.run(2 * SECOND);
      this.cpu.sysvia.keyUp(SPACE);
    }
    return {
      stopped: prompt ? "prompt" : "limit",
      cycles,
      marks: this.marks,
      text: Buffer.from(this.text).toString("latin1"),
      memory,
      video,
      back,
      cases: this.answers,
    };
  }
}

const results = [];
for (const job of JSON.parse(readFileSync(process.argv[3], "utf8"))) {
  results.push(await new Micro().go(job));
}
process.stdout.write(JSON.stringify(results));
