; acc = acc * arg, ints; saturates.
int_multiply:
        jsr magnitudes
        jsr multiply
        lda prod+4
        ora prod+5
        ora prod+6
        ora prod+7
        bne int_multiply_large
        lda prod+3
        bmi int_multiply_large
        sta acc+3
        lda prod+2
        sta acc+2
        lda prod+1
        sta acc+1
        lda prod
        sta acc
        jmp signed
int_multiply_large:
        jmp saturate
