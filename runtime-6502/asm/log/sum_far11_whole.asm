        cmp #48             ; six: one for two
        bcs log_sum_farther
        lsr
        tax
        tya
        ror
        tay
        txa
        clc
        adc #>(log_sums+3584)
        sta sums_at+1
        ldx #0
        lda (sums_at),y
        rts
log_sum_farther:
        cmp #log_far_pages
        bcs log_sum_none
        jsr log_sixteenth   ; one for sixteen
        adc #>(log_sums+9728)
        sta sums_at+1
        lda (sums_at),y
        rts
