; Of arg, which is above 0 and is shifted x bits to the left, to bit 15: 2^31 over that, in
; prod+4 and prod+5, off by less than 1.3. Looked up by the eight bits behind the first, in
; proportion.
reciprocal:
        ldx #0
        lda arg+1
        bmi reciprocal_look
        bne reciprocal_up
        ldx #8              ; eight bits at once
        ldy #0
        lda arg
        sty arg
        bmi reciprocal_look
reciprocal_up:              ; at most 7 turns
        inx
        asl arg
        rol
        bpl reciprocal_up
reciprocal_look:
        asl arg
        rol
        tay
        lda reciprocals_step,y
        sta sum_hi
        eor #$ff
        sta dif_hi
        lda reciprocals_low,y
        sta prod+4
        lda reciprocals_high,y
        sta prod+5
        ldy arg
        clc
        lda (dif_hi),y      ; what is taken away, negative and less 1: a carry is no borrow
        sbc (sum_hi),y
        sec
        adc prod+4
        sta prod+4
        bcs reciprocal_done
        dec prod+5
reciprocal_done:
        rts
