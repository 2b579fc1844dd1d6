        sta sum_lo          ; (sum_lo),y = f(a0 + y), (dif_lo),y = f(a0 - y)
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        stx sum1_lo         ; the same of a1
        stx sum1_hi
        txa
        eor #$ff
        sta dif1_lo
        sta dif1_hi
        sty sum2_lo         ; and of a2
        sty sum2_hi
        tya
        eor #$ff
        sta dif2_lo
        sta dif2_hi
