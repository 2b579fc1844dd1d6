; acc = the number of 24 bits in acc, y bits to the left; saturates.
widen24:
        ldx #0
        lda acc+2
        bpl widen24_sign
        dex
widen24_sign:
        stx acc+3
        jmp widen_bits

; The same y bits to the right, rounded.
widen24_right:
        ldx #0
        lda acc+2
        bpl widen24_right_sign
        dex
widen24_right_sign:
        stx acc+3
        jmp right32

; acc and arg, of 24 bits, both y bits to the left.
widen24_both:
        sty second
        jsr widen24
        jsr widen24_change
        ldy second
        jsr widen24
; acc and arg change places.
widen24_change:
        ldx #3
widen24_byte:
        lda acc,x
        ldy arg,x
        sta arg,x
        sty acc,x
        dex
        bpl widen24_byte
        rts
