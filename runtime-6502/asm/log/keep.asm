; acc is kept within both ends, where the flags are those of what made its high byte: beyond
; them that overflows.
log_keep:
        bvc log_kept
        bmi log_most
log_least:
        lda #$80
        sta acc+1
        lda #0
        sta acc
log_kept:
        rts

log_most:
        lda #$7f
        sta acc+1
        lda #$ff
        sta acc
        rts
