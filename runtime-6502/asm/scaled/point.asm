; How a product of two numbers of 16 bits begins, a in a and x (high):
; (sum_lo),y = f(a0 + y), (dif_lo),y = f(a0 - y), and the same of a1.
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        stx sum1_lo
        stx sum1_hi
        txa
        eor #$ff
        sta dif1_lo
        sta dif1_hi
