; acc = that of the difference of two values, kept from the least on.
log_minus:
        sec
        lda acc
        sbc arg
        tay
        lda acc+1
        sbc arg+1
        bvs log_minus_far
        bmi log_minus_less
log_minus_first:
        jsr log_difference
        jmp log_minus_kept
log_minus_far:
        bmi log_minus_first
log_minus_less:
        jsr log_exchange
        jsr log_difference
log_minus_kept:
        jsr log_grow
        bvs log_minus_least
        rts
log_minus_least:
        jmp log_least
