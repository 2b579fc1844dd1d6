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
divide16_more:              ; at most 6 turns
        dex
        asl acc
        rol
        cmp #$40
        bcc divide16_more
        bcs divide16_times
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
        sta sum1_lo         ; both are above 0: a product without signs
        sta sum1_hi
        eor #$ff
        sta dif1_lo
        sta dif1_hi
        lda acc
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy prod+4
        sec
        lda (sum1_lo),y     ; a1 b0
        sbc (dif1_lo),y
        sta prod+1
        lda (sum1_hi),y
        sbc (dif1_hi),y
        tax
        lda (sum_hi),y      ; a0 b0 / 256
        sbc (dif_hi),y
        clc
        adc prod+1
        bcc divide16_lower
        inx
divide16_lower:
        sta prod+1
        ldy prod+5
        sec
        lda (sum_lo),y      ; a0 b1
        sbc (dif_lo),y
        sta prod+2
        lda (sum_hi),y
        sbc (dif_hi),y
        sta across
        lda (sum1_lo),y     ; a1 b1
        sbc (dif1_lo),y
        sta above
        lda (sum1_hi),y
        sbc (dif1_hi),y
        tay
        clc
        lda prod+2
        adc prod+1
        sta prod+1
        txa
        adc across
        bcc divide16_across
        iny
        clc
divide16_across:
        adc above
        bcc divide16_above
        iny
divide16_above:
        sta prod+2
        tya
        ldx count
        bmi divide16_right
        cpx #17
        bcs divide16_over
        cpx #15
        bcc divide16_right
        beq divide16_round
        asl prod+1
        rol prod+2
        rol
        bmi divide16_over
divide16_round:
        ldx prod+1
        bpl divide16_rounded
        inc prod+2
        bne divide16_rounded
        clc
        adc #1
divide16_rounded:
        cmp #$80
        bcs divide16_over
        jmp divide16_sign
divide16_over:
        jmp divide16_large
divide16_under:
        jmp divide16_zero
divide16_right:
        tay
        sec
        lda #15
        sbc count
        cmp #17
        bcs divide16_under
        tax
        tya
        cpx #9
        bcc divide16_bit
        sta prod+2          ; eight bits at once
        txa
        sbc #8
        tax
        lda #0
        beq divide16_low
divide16_bit:               ; at most 8 turns
        lsr
        ror prod+2
        dex
        bne divide16_bit
        bcc divide16_sign
        bcs divide16_nearest
divide16_low:               ; at most 8 turns
        lsr prod+2
        dex
        bne divide16_low
        bcc divide16_sign
divide16_nearest:
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
