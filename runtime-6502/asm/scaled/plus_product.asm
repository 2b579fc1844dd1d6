; The lower bytes' product, and the sum of all: 32 bits in prod.
        lda (sum_lo),y      ; a0 b0
        sbc (dif_lo),y
        sta prod
        lda (sum_hi),y
        sbc (dif_hi),y
        clc
        adc prod+1
        bcc plus_product_lower
        inx
        clc
plus_product_lower:
        adc prod+2
        sta prod+1
        txa
        adc across
        bcc plus_product_across
        inc prod+3
        clc
plus_product_across:
        adc above
        sta prod+2
        bcc plus_product_done
        inc prod+3
plus_product_done:
        rts
