; acc = the natural logarithm of acc in 16.16, by a table; of 0 and below the most negative.
; Shifted until its upper bit is set, the eight bits behind that look the logarithm up, and the
; next eight, rounded, go into it in proportion; what the shifts make of it is looked up as well.
table_logarithm_least:
        lda #$ff
        sta sign
        jmp saturate
table_logarithm:
        ldy #31             ; the place of the upper bit
        lda acc+3
        bmi table_logarithm_least
        bne table_logarithm_bit
table_logarithm_byte:       ; at most 4 turns
        tya
        sec
        sbc #8
        tay
        bmi table_logarithm_least
        lda acc+2
        ldx acc+1
        stx acc+2
        ldx acc
        stx acc+1
        ldx #0
        stx acc
        tax
        beq table_logarithm_byte
        bmi table_logarithm_index
table_logarithm_bit:        ; at most 7 turns
        dey
        asl acc
        rol acc+1
        rol acc+2
        rol
        bpl table_logarithm_bit
table_logarithm_index:      ; the upper bit falls out
        asl acc+1
        rol acc+2
        rol
        tax
        asl acc+1
        lda acc+2
        adc #0
        bcc table_logarithm_entry
        inx
        bne table_logarithm_entry
        iny                 ; that of 2 is that of 1, a shift further
table_logarithm_entry:
        sty count
        tay
        sec                 ; to the next entry
        lda logarithms_low+1,x
        sbc logarithms_low,x
        sta sum_hi
        eor #$ff
        sta dif_hi
        lda logarithms_middle+1,x
        sbc logarithms_middle,x
        sta sum_lo
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod
        lda sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta prod+1
        lda (sum_hi),y
        sbc (dif_hi),y
        tay
        clc
        lda prod
        adc prod+1
        bcc table_logarithm_sum
        iny
        clc
table_logarithm_sum:
        adc logarithms_low,x
        sta prod
        tya
        adc logarithms_middle,x
        sta prod+1
        lda logarithms_high,x
        adc #0
        sta prod+2
        ldy count
        clc
        lda prod
        adc shifts_low,y
        lda prod+1
        adc shifts_middle,y
        sta acc
        lda prod+2
        adc shifts_high,y
        sta acc+1
        ldx #0
        txa
        adc shifts_whole,y
        sta acc+2
        bpl table_logarithm_sign
        dex
table_logarithm_sign:
        stx acc+3
        rts
