; acc = that of the difference of two values, kept from the least on.
log_minus:
        clc
        lda acc
        sbc arg
        tay
        lda acc+1
        sbc arg+1
        bvs log_minus_far
        bmi log_minus_less
log_minus_first:
        jsr log_difference
        jsr log_grow
        bvs log_minus_least
        rts
log_minus_far:
        bmi log_minus_first
log_minus_less:
        jsr log_difference_less
        cpx #1
        beq log_minus_least
        clc
        adc arg
        sta acc
        txa
        adc arg+1
        sta acc+1
        bvs log_minus_least
        rts
log_minus_least:
        jmp log_least
