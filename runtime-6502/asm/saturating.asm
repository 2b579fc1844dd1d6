; acc = acc + arg, saturating.
saturating_add:
        clc
        lda acc
        adc arg
        sta acc
        lda acc+1
        adc arg+1
        sta acc+1
        lda acc+2
        adc arg+2
        sta acc+2
        lda acc+3
        adc arg+3
        sta acc+3
        bvs saturating_over
        rts
saturating_over:            ; the sign came out wrong
        eor #$80
        sta sign
        jmp saturate

; acc = acc - arg, saturating.
saturating_subtract:
        sec
        lda acc
        sbc arg
        sta acc
        lda acc+1
        sbc arg+1
        sta acc+1
        lda acc+2
        sbc arg+2
        sta acc+2
        lda acc+3
        sbc arg+3
        sta acc+3
        bvs saturating_over
        rts

; acc = |acc|, saturating.
saturating_abs:
        lda acc+3
        bmi saturating_negate
        rts

; acc = -acc, saturating.
saturating_negate:
        jsr negate
        lda acc+3
        cmp #$80            ; only the most negative is its own negative
        bne saturating_done
        lda acc
        ora acc+1
        ora acc+2
        bne saturating_done
        sta sign
        jmp saturate
saturating_done:
        rts
