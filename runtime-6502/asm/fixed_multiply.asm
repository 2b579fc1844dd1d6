; acc = acc * arg in 16.16, to the nearest, halves away from zero; saturates.
fixed_multiply:
        jsr magnitudes
        lda acc+3
        ora arg+3
        bne fixed_multiply_long
        jmp fixed_multiply_short
fixed_multiply_long:
        jsr multiply
        lda prod+6
        ora prod+7
        bne fixed_multiply_large
fixed_multiply_round:
        asl prod+1          ; the bit below the last place
        lda prod+2
        adc #0
        sta acc
        lda prod+3
        adc #0
        sta acc+1
        lda prod+4
        adc #0
        sta acc+2
        lda prod+5
        adc #0
        sta acc+3
        bcs fixed_multiply_large
        bmi fixed_multiply_large
        bit sign
        bmi fixed_multiply_negative
        rts
fixed_multiply_negative:
        jmp negate
fixed_multiply_large:
        jmp saturate
; Both are below 256, as most are: three bytes each, of the lowest product the upper byte alone.
fixed_multiply_short:
        lda acc
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy arg
        lda (sum_lo),y
        cmp (dif_lo),y
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+1
        ldy arg+1           ; nothing is borrowed from a whole product
        lda (sum_lo),y
        sbc (dif_lo),y
        sta low
        lda (sum_hi),y
        sbc (dif_hi),y
        tax
        lda low
        clc
        adc prod+1
        sta prod+1
        bcc fixed_multiply_01
        inx
fixed_multiply_01:
        stx prod+2
        ldy arg+2
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta low
        lda (sum_hi),y
        sbc (dif_hi),y
        tax
        lda low
        clc
        adc prod+2
        sta prod+2
        bcc fixed_multiply_02
        inx
fixed_multiply_02:
        stx prod+3
        lda #0
        sta prod+4
        sta prod+5
        lda acc+1
        beq fixed_multiply_upper
        ldx #1
        jsr fixed_multiply_row
fixed_multiply_upper:
        lda acc+2
        beq fixed_multiply_done
        ldx #2
        jsr fixed_multiply_row
fixed_multiply_done:
        jmp fixed_multiply_round
fixed_multiply_row:         ; the byte in a, which is the one of number x
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy arg
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta low
        lda (sum_hi),y
        sbc (dif_hi),y
        tay
        lda low
        clc
        adc prod,x
        sta prod,x
        bcc fixed_multiply_0
        iny
fixed_multiply_0:
        sty carried
        ldy arg+1
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta low
        lda (sum_hi),y
        sbc (dif_hi),y
        tay
        lda low
        clc
        adc carried
        bcc fixed_multiply_1
        iny
        clc
fixed_multiply_1:
        adc prod+1,x
        sta prod+1,x
        bcc fixed_multiply_2
        iny
fixed_multiply_2:
        sty carried
        ldy arg+2
        beq fixed_multiply_3
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta low
        lda (sum_hi),y
        sbc (dif_hi),y
        tay
        lda low
        clc
        adc carried
        bcc fixed_multiply_4
        iny
        clc
fixed_multiply_4:
        adc prod+2,x
        sta prod+2,x
        bcc fixed_multiply_5
        iny
fixed_multiply_5:
        tya
        sta prod+3,x
        rts
fixed_multiply_3:           ; y = 0
        lda carried
        clc
        adc prod+2,x
        sta prod+2,x
        bcc fixed_multiply_6
        iny
fixed_multiply_6:
        tya
        sta prod+3,x
        rts
