; prod and a (high) = a times y, both signed. What is below 0 is taken for 256 more first.
product8:
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta prod
        lda (sum_hi),y      ; nothing is borrowed from a whole product
        sbc (dif_hi),y
        cpy #$80
        bcc product8_other
        sbc sum_lo
product8_other:
        bit sum_lo
        bpl product8_done
        sty arg
        sec
        sbc arg
product8_done:
        rts
