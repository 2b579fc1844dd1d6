; acc = the sum of the reals in acc and arg, kept within the ends.
log_add:
        lda acc+2
        eor arg+2
        bne log_add_unlike
        jsr log_plus
        jmp log_keep
log_add_unlike:
        sec                 ; the sign is that of the greater
        lda acc
        sbc arg
        lda acc+1
        sbc arg+1
        bvc log_add_told
        eor #$80
log_add_told:
        bpl log_add_first
        lda arg+2
        sta acc+2
log_add_first:
        jmp log_minus

; The same of the difference.
log_subtract:
        lda arg+2
        eor #1
        sta arg+2
        jmp log_add
