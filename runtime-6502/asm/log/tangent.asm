; acc = the tangent of the real in acc.
log_tangent:
        ldx #2
log_tangent_keep:
        lda acc,x
        sta prod,x
        dex
        bpl log_tangent_keep
        jsr log_cosine
        ldx #2
log_tangent_swap:
        ldy prod,x
        lda acc,x
        sta prod,x
        sty acc,x
        dex
        bpl log_tangent_swap
        jsr log_sine
        lda acc+2
        eor prod+2
        sta acc+2
        sec
        lda acc
        sbc prod
        sta acc
        lda acc+1
        sbc prod+1
        sta acc+1
        jmp log_keep
