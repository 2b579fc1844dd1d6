; acc = floor(acc / arg), ints; saturates, x / 0 too; 0 / 0 is 0.
int_divide:
        lda arg
        ora arg+1
        ora arg+2
        ora arg+3
        bne int_divide_do
        jmp divide_by_zero
int_divide_do:
        jsr divide_signed
        bit sign
        bmi int_divide_negative
        lda acc+3           ; 2^31: the most negative by -1
        bmi int_divide_large
        rts
int_divide_negative:        ; towards zero so far; a remainder makes it one less
        lda prod
        ora prod+1
        ora prod+2
        ora prod+3
        beq int_divide_exact
        inc acc
        bne int_divide_exact
        inc acc+1
        bne int_divide_exact
        inc acc+2
        bne int_divide_exact
        inc acc+3
int_divide_exact:
        jmp negate
int_divide_large:
        jmp saturate
