\ As beebasm has it.
MODE1 = &3000
ORG &1900
.start LDA #LO(MODE1) : STA &70
 LDA #HI(MODE1) : STA &71
 LDY #0
.fill LDA #&FF : STA (&70),Y : INY : BNE fill
 ASL A : ROL &70,X
 RTS
EQUB 1, "text" : EQUW start : SKIP 4
SAVE "NAME", start, *
