; fa = the int in acc
float_from_int:
        lda acc+3
        sta float_sign
        bpl float_from_plus
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
        lda #0
        sbc acc+2
        sta acc+2
        lda #0
        sbc acc+3
        sta acc+3
float_from_plus:
        lda acc+2
        ora acc+3
        beq float_from_short
        ldx #3
float_from_byte:
        lda acc,x
        sta fa,x
        dex
        bpl float_from_byte
        inx
        stx float_guard
        stx float_exp+1
        lda #160
        sta float_exp
        jmp float_normal
float_from_short:           ; of two bytes
        sta fa
        sta fa+1
        ldx #144
        ldy acc
        lda acc+1
        bne float_from_bits
        ldx #136
        tya
        beq float_from_zero
        ldy #0
float_from_bits:
        sty fa+2
        cmp #0
        bmi float_from_packed
float_from_bit:
        dex
        asl fa+2
        rol
        bpl float_from_bit
float_from_packed:
        stx fa+4
        and #$7f
        bit float_sign
        bpl float_from_signed
        ora #$80
float_from_signed:
        sta fa+3
        rts
float_from_zero:
        sta fa+2
        sta fa+3
        sta fa+4
        rts
