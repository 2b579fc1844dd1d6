; The product's upper 16 bits, rounded, in prod+2 and a (high).
multiply16:
        jsr product16
round16:
        ldx prod+1
        bpl round16_done
        inc prod+2
        bne round16_done
        clc
        adc #1
round16_done:
        rts
