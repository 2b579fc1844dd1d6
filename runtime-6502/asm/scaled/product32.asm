; The product of two numbers of 16 bits, a in a and x (high), b in arg: all its 32 bits in
; prod. The lower bytes' product, of which the upper 24 have all but what it borrows.
product32:
        jsr product16
        sta prod+3
        ldy arg
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta prod
        bcs product32_done
        lda prod+1
        bne product32_low
        lda prod+2
        bne product32_middle
        dec prod+3
product32_middle:
        dec prod+2
product32_low:
        dec prod+1
product32_done:
        rts
