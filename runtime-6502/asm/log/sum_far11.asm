        cmp #48             ; six: one for two
        bcs log_sum_farther
        lsr
        tax
        tya
        ror
        tay
        txa
        cmp #14             ; from there on it is a byte
        bcs log_sum_byte
        adc #>(log_sums+2048)
        bcc log_sum_both
log_sum_byte:
        adc #>(log_sums+1792)
        sta sums_at+1
        ldx #0
        lda (sums_at),y
        rts
log_sum_farther:
        cmp #log_far_pages
        bcs log_sum_none
        jsr log_sixteenth   ; one for sixteen
        adc #>(log_sums+8192)
        sta sums_at+1
        lda (sums_at),y
        rts
