; The square of a, x and y (high): what product24 makes of a number and itself.
square24:
        sta arg
        stx arg+1
        sty arg+2
        stx sum1_lo
        stx sum1_hi
        sty sum2_lo
        sty sum2_hi
        txa
        eor #$ff
        sta dif1_lo
        sta dif1_hi
        tya
        eor #$ff
        sta dif2_lo
        sta dif2_hi
        ldy arg
        sec
        lda (sum1_hi),y     ; a0 a1 / 256
        sbc (dif1_hi),y
        sta prod+2
        lda (sum2_lo),y     ; a0 a2
        sbc (dif2_lo),y
        sta prod+3
        lda (sum2_hi),y
        sbc (dif2_hi),y
        tax
        lda prod+3          ; both of them twice, a2 a0 to the left
        clc
        adc prod+2
        bcc square24_twice
        inx
square24_twice:
        asl
        sta prod+2
        txa
        rol
        sta prod+3
        lda #0
        rol
        sta prod+4
        ldy arg+1
        sec
        lda (sum2_lo),y     ; a1 a2
        sbc (dif2_lo),y
        sta across
        lda (sum2_hi),y
        sbc (dif2_hi),y
        sta above
        lda (sum1_lo),y     ; a1 a1
        clc
        adc prod+2
        sta prod+2
        lda (sum1_hi),y
        adc prod+3
        sta prod+3
        bcc square24_middle
        inc prod+4
square24_middle:
        asl across
        rol above
        lda #0
        rol
        sta prod+5
        clc
        lda across
        adc prod+3
        sta prod+3
        lda above
        adc prod+4
        sta prod+4
        bcc square24_upper
        inc prod+5
        clc
square24_upper:
        ldy arg+2
        lda (sum2_lo),y     ; a2 a2
        adc prod+4
        sta prod+4
        lda (sum2_hi),y
        adc prod+5
        tax
        lda arg+2           ; below 0 it was taken for 2^24 more, twice
        bpl square24_done
        asl arg
        rol arg+1
        rol arg+2
        sec
        lda prod+3
        sbc arg
        sta prod+3
        lda prod+4
        sbc arg+1
        sta prod+4
        txa
        sbc arg+2
        rts
square24_done:
        txa
        rts
