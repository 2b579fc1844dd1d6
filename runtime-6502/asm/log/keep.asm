; acc is kept from the least on, where the flags are those of its high byte.
log_keep_low:
        bpl log_kept
        cmp #$cc
        bcs log_kept
log_least:
        lda #$cc
        sta acc+1
        lda #0
        sta acc
log_kept:
        rts

; acc kept within both ends, where the flags are those of its high byte.
log_keep:
        bmi log_keep_low
        cmp #$40
        bcc log_kept
log_most:
        lda #$3f
        sta acc+1
        lda #$ff
        sta acc
        rts
