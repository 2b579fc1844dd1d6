; The lower bytes' product, of which only upper bytes are subtracted, so that the upper 24
; bits, in prod+1, prod+2 and a (high), may be one of their units off; then the signs.
        lda (sum_hi),y      ; a0 b0 / 256
        sbc (dif_hi),y
        clc
        adc prod+1
        bcc product16_lower
        inx
        clc
product16_lower:
        adc prod+2
        sta prod+1
        txa
        adc across
        bcc product16_across
        inc prod+3
        clc
product16_across:
        adc above
        sta prod+2
        lda prod+3
        adc #0
        ldx sum1_lo         ; a below 0 was taken for 65536 more
        bpl product16_other
        tax
        sec
        lda prod+2
        sbc arg
        sta prod+2
        txa
        sbc arg+1
product16_other:
        ldx arg+1           ; and so was b
        bpl product16_done
        tax
        sec
        lda prod+2
        sbc sum_lo
        sta prod+2
        txa
        sbc sum1_lo
product16_done:
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
