; acc = acc - arg floor(acc / arg), as `modulo` has it, of 24 bits.
modulo24:
        ldy #0
        jsr widen24_both
        jmp modulo
