; a and x (high) = a and x - arg floor(a and x / arg), with the sign of arg; 0 where arg
; is 0. Numbers of 16 bits with one point. The divisor is doubled up to the dividend and
; taken off on its way back: a step for each bit of the quotient, which has few.
modulo16:
        sta acc
        stx acc+1
        lda arg+1
        sta mixed
        bpl modulo16_divisor
        sec
        lda #0
        sbc arg
        sta arg
        lda #0
        sbc arg+1
        sta arg+1
modulo16_divisor:
        ora arg
        beq modulo16_zero
        txa
        eor mixed
        sta sign
        txa
        bpl modulo16_start
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
modulo16_start:
        ldy #0
modulo16_up:                ; at most 16 turns
        lda acc
        cmp arg
        lda acc+1
        sbc arg+1
        bcc modulo16_down
        iny
        asl arg
        rol arg+1
        bcs modulo16_none   ; both are 32768
        bpl modulo16_up
        bmi modulo16_try
modulo16_down:              ; at most 17 turns
        dey
        bmi modulo16_rest
        lsr arg+1
        ror arg
modulo16_try:
        sec
        lda acc
        sbc arg
        tax
        lda acc+1
        sbc arg+1
        bcc modulo16_down
        sta acc+1
        stx acc
        bcs modulo16_down
modulo16_none:
        lda #0
modulo16_zero:
        tax
        rts
modulo16_rest:
        lda acc
        ora acc+1
        beq modulo16_zero
        bit sign            ; unlike signs: the rest is counted from the other end
        bpl modulo16_sign
        sec
        lda arg
        sbc acc
        sta acc
        lda arg+1
        sbc acc+1
        sta acc+1
modulo16_sign:
        lda acc
        ldx acc+1
        bit mixed
        bpl modulo16_done
        sec
        lda #0
        sbc acc
        tay
        lda #0
        sbc acc+1
        tax
        tya
modulo16_done:
        rts
