; Z: whether the logarithm of the whole number in acc, at most 512, is the one in log_x.
log_is_whole:
        jsr log_of_acc
        cmp log_x
        bne log_is_whole_told
        cpx log_x+1
log_is_whole_told:
        rts

; a x = the logarithm of the whole number in acc, at most 512.
log_of_acc:
        ldy acc
        lda acc+1
        beq log_of_low
        lsr
        bne log_of_512
        ldx log_logs_high+256,y
        lda log_logs_low+256,y
        rts
log_of_low:
        ldx log_logs_high,y
        lda log_logs_low,y
        rts
log_of_512:
        lda #0
        ldx #9*log_octave
        rts
