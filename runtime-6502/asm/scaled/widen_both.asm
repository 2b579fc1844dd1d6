; acc = a and x (high), arg = 16 bits of arg, both y bits to the left.
widen_both:
        sta first
        stx first+1
        sty second
        lda arg
        ldx arg+1
        jsr widen
        jsr second_operand
        ldy second
        lda first
        ldx first+1
        jmp widen

; arg = acc.
second_operand:
        lda acc
        sta arg
        lda acc+1
        sta arg+1
        lda acc+2
        sta arg+2
        lda acc+3
        sta arg+3
        rts
