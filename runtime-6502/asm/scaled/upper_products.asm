; All products of bytes but a0 b0; b is in arg. Leaves y for b0 and a set carry.
        ldy arg+1
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
        sta prod+3
        ldy arg             ; nothing is borrowed from a whole product
        lda (sum1_lo),y     ; a1 b0
        sbc (dif1_lo),y
        sta prod+1
        lda (sum1_hi),y
        sbc (dif1_hi),y
        tax
