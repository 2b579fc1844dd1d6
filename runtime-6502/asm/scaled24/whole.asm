        ldy arg
        sec
        lda (sum_lo),y      ; a0 b0
        sbc (dif_lo),y
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+1
        lda (sum1_lo),y     ; a1 b0
        sbc (dif1_lo),y
        tax
        lda (sum1_hi),y
        sbc (dif1_hi),y
        sta prod+2
        lda (sum2_lo),y     ; a2 b0
        sbc (dif2_lo),y
        sta across
        lda (sum2_hi),y
        sbc (dif2_hi),y
        sta prod+3
        txa
        clc
        adc prod+1
        sta prod+1
        lda across
        adc prod+2
        sta prod+2
        bcc whole24_middle
        inc prod+3
whole24_middle:
        ldy arg+1
        sec
        lda (sum_lo),y      ; a0 b1
        sbc (dif_lo),y
        tax
        lda (sum_hi),y
        sbc (dif_hi),y
        sta across
        lda (sum1_lo),y     ; a1 b1
        sbc (dif1_lo),y
        sta above
        lda (sum1_hi),y
        sbc (dif1_hi),y
        sta beside
        lda (sum2_lo),y     ; a2 b1
        sbc (dif2_lo),y
        sta beneath
        lda (sum2_hi),y
        sbc (dif2_hi),y
        sta prod+4
        txa
        clc
        adc prod+1
        sta prod+1
        lda across
        adc prod+2
        sta prod+2
        lda beside
        adc prod+3
        sta prod+3
        bcc whole24_rest
        inc prod+4
        clc
whole24_rest:
        lda above
        adc prod+2
        sta prod+2
        lda beneath
        adc prod+3
        sta prod+3
        bcc whole24_upper
        inc prod+4
whole24_upper:
        jmp product24_upper ; and a b2, and what signs take
