; acc = acc * arg, ints of 16 bits.
int_product:
        lda acc
        ldx acc+1
; acc = the product of a and x (high), and arg.
exact32:
        jsr product32
        lda prod
        sta acc
        lda prod+1
        sta acc+1
        lda prod+2
        sta acc+2
        lda prod+3
        sta acc+3
        rts
