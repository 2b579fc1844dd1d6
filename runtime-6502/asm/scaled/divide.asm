; a and x (high) = acc / arg with y bits more, rounded; saturates. By 0 the greatest with
; the sign of acc. Magnitudes are shifted first, acc to bit 14 and arg to bit 15, so that
; the product with the reciprocal has all the bits that there are.
divide16:
        sty count
        lda acc+1
        eor arg+1
        sta sign
        lda acc+1
        bpl divide16_plus
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
divide16_plus:
        ora acc
        beq divide16_zero
        lda arg+1
        bpl divide16_divisor
        sec
        lda #0
        sbc arg
        sta arg
        lda #0
        sbc arg+1
        sta arg+1
divide16_divisor:
        ora arg
        beq divide16_large
        jsr reciprocal
        txa
        clc
        adc count
        tax
        lda acc+1
        bne divide16_up
        lda acc             ; eight bits at once
        ldy #0
        sty acc
        sta acc+1
        txa
        sec
        sbc #8
        tax
        lda acc+1
        bpl divide16_up
        lsr                 ; one too many
        ror acc
        inx
divide16_up:
        cmp #$40
        bcs divide16_times
        asl acc
        rol
        dex
        jmp divide16_up
divide16_zero:
        lda #0
        tax
        rts
divide16_large:
        bit sign
        bmi divide16_least
        lda #$ff
        ldx #$7f
        rts
divide16_least:
        lda #1
        ldx #$80
        rts
divide16_times:
        stx count           ; the quotient's bits before the point, of those that follow
        sta acc+1
        tax
        lda prod+4          ; the reciprocal less 65536
        sta arg
        lda prod+5
        sta arg+1
        lda acc
        jsr product16
        tax
        clc
        lda prod+2          ; and acc, for that 65536
        adc acc
        sta prod+2
        txa
        adc acc+1
        ldx count
        bmi divide16_right
        cpx #17
        bcs divide16_large
        cpx #15
        bcc divide16_right
        beq divide16_round
        asl prod+1
        rol prod+2
        rol
        bmi divide16_large
divide16_round:
        ldx prod+1
        bpl divide16_rounded
        inc prod+2
        bne divide16_rounded
        clc
        adc #1
divide16_rounded:
        cmp #$80
        bcs divide16_large
        jmp divide16_sign
divide16_right:
        tay
        sec
        lda #15
        sbc count
        cmp #17
        bcs divide16_zero
        tax
        tya
divide16_bit:
        lsr
        ror prod+2
        dex
        bne divide16_bit
        bcc divide16_sign
        inc prod+2
        bne divide16_sign
        adc #0
divide16_sign:
        tax
        lda prod+2
        bit sign
        bmi divide16_minus
        rts
divide16_minus:
        stx prod+3
        sec
        lda #0
        sbc prod+2
        tay
        lda #0
        sbc prod+3
        tax
        tya
        rts
