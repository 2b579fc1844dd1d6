        ldy arg+1
        sec
        lda (sum_hi),y      ; a0 b1 / 256; no product borrows, so the carry stays
        sbc (dif_hi),y
        sta prod+2
        lda (sum1_lo),y     ; a1 b1
        sbc (dif1_lo),y
        tax
        lda (sum1_hi),y
        sbc (dif1_hi),y
        sta prod+3
        lda (sum2_lo),y     ; a2 b1
        sbc (dif2_lo),y
        sta across
        lda (sum2_hi),y
        sbc (dif2_hi),y
        sta prod+4
        txa
        clc
        adc prod+2
        sta prod+2
        lda across
        adc prod+3
        sta prod+3
        bcc product24_lower
        inc prod+4
product24_lower:
        ldy arg
        sec
        lda (sum1_hi),y     ; a1 b0 / 256
        sbc (dif1_hi),y
        tax
        lda (sum2_lo),y     ; a2 b0
        sbc (dif2_lo),y
        sta across
        lda (sum2_hi),y
        sbc (dif2_hi),y
        sta above
        txa
        clc
        adc across
        bcc product24_third
        inc above
        clc
product24_third:
        adc prod+2
        sta prod+2
        lda above
        adc prod+3
        sta prod+3
        bcc product24_upper
        inc prod+4
product24_upper:
        ldy arg+2
        sec
        lda (sum_lo),y      ; a0 b2
        sbc (dif_lo),y
        tax
        lda (sum_hi),y
        sbc (dif_hi),y
        sta across
        lda (sum1_lo),y     ; a1 b2
        sbc (dif1_lo),y
        sta above
        lda (sum1_hi),y
        sbc (dif1_hi),y
        sta beside
        lda (sum2_lo),y     ; a2 b2
        sbc (dif2_lo),y
        sta beneath
        lda (sum2_hi),y
        sbc (dif2_hi),y
        sta prod+5
        txa
        clc
        adc prod+2
        sta prod+2
        lda across
        adc prod+3
        sta prod+3
        lda beside
        adc prod+4
        sta prod+4
        bcc product24_add
        inc prod+5
        clc
product24_add:
        lda above
        adc prod+3
        sta prod+3
        lda beneath
        adc prod+4
        sta prod+4
        lda prod+5
        adc #0
        tax
        lda sum2_lo         ; a below 0 was taken for 2^24 more
        bpl product24_other
        sec
        lda prod+3
        sbc arg
        sta prod+3
        lda prod+4
        sbc arg+1
        sta prod+4
        txa
        sbc arg+2
        tax
product24_other:
        lda arg+2           ; and so was b
        bpl product24_done
        sec
        lda prod+3
        sbc sum_lo
        sta prod+3
        lda prod+4
        sbc sum1_lo
        sta prod+4
        txa
        sbc sum2_lo
        rts
product24_done:
        txa
        rts
