; The product of two numbers of 16 bits, a in a and x (high), b in arg: its upper 24 bits
; in prod+1, prod+2 and a (high). Of the lower bytes' product only upper bytes are
; subtracted, so that it may be one of the 24 bits' units off.
product16:
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
        ldy arg
        sec
        lda (sum1_lo),y     ; a1 b0
        sbc (dif1_lo),y
        sta prod+1
        lda (sum1_hi),y
        sbc (dif1_hi),y
        tax
        lda (sum_hi),y      ; a0 b0 / 256
        sbc (dif_hi),y
        clc
        adc prod+1
        bcc product16_lower
        inx
product16_lower:
        sta prod+1
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
        tay
        clc
        lda prod+2
        adc prod+1
        sta prod+1
        txa
        adc across
        bcc product16_across
        iny
        clc
product16_across:
        adc above
        bcc product16_above
        iny
product16_above:
        sta prod+2
        tya
        tax
        lda sum1_lo         ; a below 0 was taken for 65536 more
        bpl product16_other
        sec
        lda prod+2
        sbc arg
        sta prod+2
        txa
        sbc arg+1
        tax
product16_other:
        lda arg+1           ; and so was b
        bpl product16_done
        sec
        lda prod+2
        sbc sum_lo
        sta prod+2
        txa
        sbc sum1_lo
        rts
product16_done:
        txa
        rts

; Pages of the pointers into the quarter squares.
set_squares:
        lda #>(sqr_lo)
        sta sum1_lo+1
        lda #>(sqr_hi)
        sta sum1_hi+1
        lda #>(sqd_lo)
        sta dif1_lo+1
        lda #>(sqd_hi)
        sta dif1_hi+1
        rts
