; Bits 8 to 23 of it in a and x (high), rounded: all there is where that fits, so nothing is
; made of what is above.
        ldy arg+1
        sec
        lda (sum_lo),y      ; a0 b1
        sbc (dif_lo),y
        sta prod+1
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+2
        lda (sum1_lo),y     ; a1 b1, of which the upper byte is above
        sbc (dif1_lo),y
        clc
        adc prod+2
        cpy #$80            ; what is below 0 was taken for 65536 more
        bcc middle16_other
        sbc sum_lo
middle16_other:
        sta prod+2
        ldy arg
        sec
        lda (sum1_lo),y     ; a1 b0
        sbc (dif1_lo),y
        tax
        lda (sum1_hi),y
        sbc (dif1_hi),y
        clc
        adc prod+2
        bit sum1_lo
        bpl middle16_sign
        sec
        sbc arg
middle16_sign:
        sta prod+2
        sec
        lda (sum_lo),y      ; a0 b0, of which the lower byte only rounds
        sbc (dif_lo),y
        sta prod
        lda (sum_hi),y
        sbc (dif_hi),y
        asl prod
        adc prod+1
        bcc middle16_low
        inc prod+2
        clc
middle16_low:
        sta prod+1
        txa
        adc prod+1
        bcc middle16_high
        inc prod+2
middle16_high:
        ldx prod+2
        rts
