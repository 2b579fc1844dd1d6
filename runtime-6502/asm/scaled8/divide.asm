; a = acc / arg, numbers of 16 bits, with y bits more, rounded, in 8 bits; saturates. By 0 the
; greatest with the sign of acc. What is left of the divisor behind its first bit is looked up
; by eight bits, and the dividend is multiplied by what is found.
divide8_zero:
        lda #0
        rts
divide8_large:
        lda #$7f
        bit sign
        bpl divide8_held
        lda #$81
divide8_held:
        rts
divide8:
        sty count
        lda acc+1
        eor arg+1
        sta sign
        lda acc+1
        bpl divide8_plus
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
divide8_plus:
        ora acc
        beq divide8_zero
        lda arg+1
        bpl divide8_divisor
        sec
        lda #0
        sbc arg
        sta arg
        lda #0
        sbc arg+1
        sta arg+1
divide8_divisor:
        ora arg
        beq divide8_large
        ldx count           ; the quotient's bits before the point, of those that follow
        lda arg+1
        bne divide8_up
        txa
        clc
        adc #8              ; eight bits at once
        tax
        ldy #0
        lda arg
        sty arg
        bmi divide8_look
divide8_up:                 ; at most 7 turns
        inx
        asl arg
        rol
        bpl divide8_up
divide8_look:
        asl arg
        rol
        tay
        lda inverses,y
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        lda acc+1
        bne divide8_scale
        txa
        sec
        sbc #8              ; eight bits at once
        tax
        ldy #0
        lda acc
        sty acc
        bmi divide8_times
divide8_scale:              ; at most 7 turns
        dex
        asl acc
        rol
        bpl divide8_scale
divide8_times:
        tay                 ; the upper byte, with all that is below it
        lda (sum_lo),y
        sec
        sbc (dif_lo),y
        sta prod
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+1
        ldy acc
        lda (sum_hi),y
        sbc (dif_hi),y
        clc
        adc prod
        bcc divide8_made
        inc prod+1
divide8_made:               ; from 2^14 to 2^16 in prod+1 and a
        sta prod
        txa
        sec
        sbc #7
        tax
        beq divide8_nearest
        bpl divide8_over
        cmp #$f8
        bcc divide8_under
        lda prod+1
divide8_right:              ; at most 8 turns
        lsr
        inx
        bne divide8_right
        beq divide8_round
divide8_nearest:
        asl prod
        lda prod+1
divide8_round:
        adc #0
        bmi divide8_over
        bit sign
        bmi divide8_minus
        rts
divide8_minus:
        eor #$ff
        clc
        adc #1
        rts
divide8_under:
        jmp divide8_zero
divide8_over:
        jmp divide8_large
