; acc = the int in acc over the one in arg, as a real.
log_ratio:
        lda arg
        sta log_z
        lda arg+1
        sta log_z+1
        lda arg+2
        sta log_c
        lda arg+3
        sta log_c+1
        jsr log_from_int
        ldx #3
log_ratio_swap:
        lda acc,x
        pha
        lda log_z,x
        sta acc,x
        pla
        sta log_z,x
        dex
        bpl log_ratio_swap
        jsr log_from_int
        lda log_c
        sta acc+2
        sec
        lda log_z
        sbc acc
        sta acc
        lda log_z+1
        sbc acc+1
        sta acc+1
        jmp log_keep
