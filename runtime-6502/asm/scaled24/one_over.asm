; prod+3, prod+4 and a (high) = a power of two over arg: the reciprocal y bits to the right,
; less those that arg was shifted; saturates, by 0 too.
one_over24:
        sty count
        lda arg+2
        sta carried
        bpl one_over24_plus
        sec
        lda #0
        sbc arg
        sta arg
        lda #0
        sbc arg+1
        sta arg+1
        lda #0
        sbc arg+2
        sta arg+2
one_over24_plus:
        ora arg+1
        ora arg
        beq one_over24_large
        jsr reciprocal24
        stx across
        lda count
        sec
        sbc across
        beq one_over24_large
        bmi one_over24_large
        tay
        lda prod+5
; a, prod+4 and prod+3 y bits to the right, rounded, without a sign; then that of carried.
quotient24_right:
        cpy #26
        bcs one_over24_zero
        cpy #9
        bcc quotient24_bit
        ldx prod+4          ; a whole byte
        stx prod+3
        sta prod+4
        tya
        sbc #8
        tay
        lda #0
        beq quotient24_right
quotient24_bit:
        lsr
        ror prod+4
        ror prod+3
        dey
        bne quotient24_bit
quotient24_round:
        bcc quotient24_sign
        inc prod+3
        bne quotient24_sign
        inc prod+4
        bne quotient24_sign
        clc
        adc #1
quotient24_sign:
        tax
        bmi one_over24_large
        bit carried
        bmi one_over24_minus
        rts
one_over24_minus:
        stx prod+5
        sec
        lda #0
        sbc prod+3
        sta prod+3
        lda #0
        sbc prod+4
        sta prod+4
        lda #0
        sbc prod+5
        rts
one_over24_zero:
        lda #0
        sta prod+3
        sta prod+4
        rts
one_over24_large:
        lda #$ff
        sta prod+3
        sta prod+4
        ldx #$7f
        txa
        bit carried
        bmi one_over24_minus
        rts
