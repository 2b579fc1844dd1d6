"""Runs a .prg on c64py's Commodore 64, without ROMs, until it looks at the keyboard.

    python3 c64.py PATH-OF-THE-PACKAGE PROGRAM.prg

Prints JSON: the cycles since the program's first instruction, the registers of the video
chip and of its bank, and memory, hex.
"""
import json
import sys

sys.path.insert(0, sys.argv[1])
from c64py.cpu import CPU6502  # noqa: E402
from c64py.memory import MemoryMap  # noqa: E402

KEY = bytes([0xAD, 0x01, 0xDC])
LIMIT = 40_000_000

image = open(sys.argv[2], "rb").read()
origin = image[0] | image[1] << 8
code = image[2:]
# 10 SYS 2061; and where it waits for a key.
begin = int(code[5 : code.index(0, 5)])
wait = origin + code.index(KEY)

# As the KERNAL leaves the machine.
memory = MemoryMap()
memory.ram[0:2] = bytes([0x2F, 0x37])
memory.invalidate_6510_port_read_cache()
memory.ram[origin : origin + len(code)] = code
for register, value in ((0xD011, 0x1B), (0xD016, 0xC8), (0xD018, 0x15), (0xDD02, 0x3F), (0xDD00, 3)):
    memory.write(register, value)
cpu = CPU6502(memory, accurate_vic=True)
state = cpu.state
state.pc, state.sp = begin, 0xF0
start = state.cycles
while state.pc != wait and state.cycles - start < LIMIT:
    cpu.step()
registers = {hex(0xD000 + r): memory.vic_stored_reg(r) for r in (0x11, 0x16, 0x18, 0x20, 0x21)}
print(json.dumps({
    "cycles": state.cycles - start,
    "ended": state.pc == wait,
    "registers": registers | {"0xdd00": memory.cia2_pra},
    "memory": bytes(memory.ram).hex(),
}))
