; acc = acc - arg floor(acc / arg), with the sign of arg; 0 where arg is 0.
; The same for ints and for fixed point.
modulo:
        lda arg
        ora arg+1
        ora arg+2
        ora arg+3
        beq modulo_zero
        lda arg+3
        sta mixed
        jsr divide_signed
        lda prod
        ora prod+1
        ora prod+2
        ora prod+3
        beq modulo_zero
        bit sign            ; unlike signs: the rest is counted from the other end
        bpl modulo_rest
        sec
        lda arg
        sbc prod
        sta acc
        lda arg+1
        sbc prod+1
        sta acc+1
        lda arg+2
        sbc prod+2
        sta acc+2
        lda arg+3
        sbc prod+3
        sta acc+3
        jmp modulo_sign
modulo_rest:
        lda prod
        sta acc
        lda prod+1
        sta acc+1
        lda prod+2
        sta acc+2
        lda prod+3
        sta acc+3
modulo_sign:
        bit mixed
        bpl modulo_done
        jmp negate
modulo_zero:
        sta acc             ; a is 0
        sta acc+1
        sta acc+2
        sta acc+3
modulo_done:
        rts
