        cmp #24
        bcc log_sum_byte
        cmp #log_far_pages
        bcs log_sum_none
        jmp log_rest
log_sum_byte:
        adc #>(log_sums)
        sta sums_at+1
        ldx #0
        lda (sums_at),y
        rts
