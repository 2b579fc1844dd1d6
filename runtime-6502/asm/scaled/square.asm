; The square of a and x (high): its upper 24 bits in prod+1, prod+2 and a (high).
square16:
        cpx #$80
        bcc square16_plus
        eor #$ff
        clc
        adc #1
        tay
        txa
        eor #$ff
        adc #0
        tax
        tya
square16_plus:
        sta sum_hi
        tay
        lda (sum_hi),y      ; a0 a0 / 256
        sta prod+1
        stx sum1_lo
        stx sum1_hi
        txa
        eor #$ff
        sta dif1_lo
        sta dif1_hi
        sec
        lda (sum1_lo),y     ; 2 a0 a1
        sbc (dif1_lo),y
        sta across
        lda (sum1_hi),y
        sbc (dif1_hi),y
        asl across
        rol
        sta prod+2
        clc
        lda across
        adc prod+1
        sta prod+1
        ldy sum1_lo
        lda (sum1_lo),y     ; a1 a1
        adc prod+2
        sta prod+2
        lda (sum1_hi),y
        adc #0
        rts
