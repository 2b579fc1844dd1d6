; Behind the pages with upper bytes.
log_sum_slow:
        cmp #24
        bcc log_sum_byte
        jmp log_rest
log_sum_byte:
        adc #>(log_sums)
        sta sums_at+1
        ldx #0
        lda (sums_at),y
        rts
