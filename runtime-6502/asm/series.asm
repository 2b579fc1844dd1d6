; acc = c0 - x (c1 - x (c2 - ...)), or with + throughout, for x = arg, which
; stays; all unsigned: x in 0.32, the rest in 1.31, what lies below cut off.
; At (terms): how many terms follow the first, a mask ($ff for -, 0 for +), the
; terms from the last to c0, each exclusive-or the mask: ~(~c + h) is c - h.
terms = $14       ; a pointer; the bits and count of a division are free here
series:
        ldy #0
        lda (terms),y
        sta series_left
        iny
        lda (terms),y
        sta series_mask
        iny
        ldx #0
series_first:
        lda (terms),y
        eor series_mask
        sta acc,x
        iny
        inx
        cpx #4
        bne series_first
series_next:
        sty series_at
        jsr multiply
        ldy series_at
        clc
        lda (terms),y
        adc prod+4
        eor series_mask
        sta acc
        iny
        lda (terms),y
        adc prod+5
        eor series_mask
        sta acc+1
        iny
        lda (terms),y
        adc prod+6
        eor series_mask
        sta acc+2
        iny
        lda (terms),y
        adc prod+7
        eor series_mask
        sta acc+3
        iny
        dec series_left
        bne series_next
        rts

; acc = x P(x x), with the terms of P at (terms), for x = acc in 0.32: the whole
; product is in prod, with 63 bits behind the point.
odd_series:
        ldx #3
odd_series_keep:
        lda acc,x
        sta series_x,x
        sta arg,x
        dex
        bpl odd_series_keep
        jsr multiply
        ldx #3
odd_series_square:
        lda prod+4,x
        sta arg,x
        dex
        bpl odd_series_square
        jsr series
        ldx #3
odd_series_again:
        lda series_x,x
        sta arg,x
        dex
        bpl odd_series_again
        jmp multiply
series_left:
        .byte 0
series_mask:
        .byte 0
series_at:
        .byte 0
series_x:
        .byte 0, 0, 0, 0
