; Quarter squares, f(n) = floor(n n / 4), made once at the start.
; a b = f(a + b) - f(a - b), exactly: a + b and a - b are both even or both odd.
sqr_lo = $0200    ; f(n), low bytes, n = 0 to 511
sqr_hi = $0400    ; high bytes
sqd_lo = $0600    ; f(n - 255), n = 0 to 510
sqd_hi = $0800

make_squares:
        lda #>(sqr_lo)
        sta sum_lo+1
        lda #>(sqr_hi)
        sta sum_hi+1
        lda #>(sqd_lo)
        sta dif_lo+1
        lda #>(sqd_hi)
        sta dif_hi+1
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
