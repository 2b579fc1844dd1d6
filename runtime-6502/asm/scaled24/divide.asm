; prod+3, prod+4 and a (high) = acc / arg with y bits more, rounded; saturates. By 0 the
; greatest with the sign of acc. Magnitudes are shifted first, acc to bit 22 and arg to bit
; 23, so that the product with the reciprocal has all the bits that there are.
divide24:
        sty count
        lda acc+2
        eor arg+2
        sta carried
        lda acc+2
        bpl divide24_plus
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
divide24_plus:
        ora acc
        ora acc+1
        beq one_over24_zero
        lda arg+2
        bpl divide24_divisor
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
divide24_divisor:
        ora arg
        ora arg+1
        beq one_over24_large
        jsr reciprocal24
        txa
        clc
        adc count
        tax
        lda acc+2
        bne divide24_up
divide24_byte:
        ldy acc             ; eight bits at once
        lda acc+1
        sty acc+1
        ldy #0
        sty acc
        pha
        txa
        sec
        sbc #8
        tax
        pla
        beq divide24_byte
        bpl divide24_up
        lsr                 ; one too many
        ror acc+1
        ror acc
        inx
divide24_up:
        cmp #$40
        bcs divide24_times
        asl acc
        rol acc+1
        rol
        dex
        jmp divide24_up
divide24_times:
        stx count           ; the quotient's bits before the point, of those that follow
        sta arg+2
        lda acc+1
        sta arg+1
        lda acc
        sta arg
        lda prod+3
        ldx prod+4
        ldy prod+5
        jsr product24       ; which takes the reciprocal for 2^24 less
        tax
        clc
        lda prod+3
        adc arg
        sta prod+3
        lda prod+4
        adc arg+1
        sta prod+4
        txa
        adc arg+2
        tax
        lda count
        sec
        sbc #23
        beq divide24_round
        bpl divide24_left
        eor #$ff
        clc
        adc #1
        tay
        txa
        jmp quotient24_right
divide24_left:
        cmp #2
        bcs divide24_large
        asl prod+2
        rol prod+3
        rol prod+4
        txa
        rol
        bmi divide24_large
        tax
divide24_round:
        asl prod+2
        txa
        jmp quotient24_round
divide24_large:
        jmp one_over24_large
