; acc = the product of a and x (high), and arg.
exact32:
        ldy #0
        jsr widen_both
        jmp int_multiply
