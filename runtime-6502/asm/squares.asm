        ldx #255
        ldy #0              ; n
        sty acc             ; f(n)
        sty acc+1
squares_low:                ; n = 0 to 255, with x = 255 - n
        lda acc
        sta sqr_lo,y
        sta sqd_lo+255,y
        sta sqd_lo,x
        lda acc+1
        sta sqr_hi,y
        sta sqd_hi+255,y
        sta sqd_hi,x
        tya                 ; f(n + 1) = f(n) + floor((n + 1) / 2)
        lsr
        adc acc
        sta acc
        bcc squares_next
        inc acc+1
squares_next:
        dex
        iny
        bne squares_low
squares_high:               ; n = 256 to 511
        lda acc
        sta sqr_lo+256,y
        lda acc+1
        sta sqr_hi+256,y
        tya
        lsr
        adc #128            ; carries for the last n only, which needs no successor
        clc
        adc acc
        sta acc
        bcc squares_more
        inc acc+1
squares_more:
        iny
        bne squares_high
        rts
