; acc = the logarithm of the sum of two values above 0, from those in acc and arg.
log_plus:
        sec
        lda acc
        sbc arg
        tay
        lda acc+1
        sbc arg+1
        bvs log_plus_far
        bmi log_plus_less
log_plus_first:
        jsr log_sum
        jmp log_grow
log_plus_far:
        bmi log_plus_first
log_plus_less:
        jsr log_exchange
        jsr log_sum
; acc = acc + what a and x have; the flags are those of the high byte.
log_grow:
        adc acc
        sta acc
        txa
        adc acc+1
        sta acc+1
        rts

; acc and arg change places; y a = the first less the second then.
log_exchange:
        ldx acc
        lda arg
        sta acc
        stx arg
        ldx acc+1
        lda arg+1
        sta acc+1
        stx arg+1
        sec
        lda acc
        sbc arg
        tay
        lda acc+1
        sbc arg+1
        rts
