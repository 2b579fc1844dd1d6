set_sums:
        lda #<(log_sums)
        sta sums_at
        sta sums_up
        rts

; a x = low and high byte of what the greater of two logarithms grows by, in a sum of two
; values of one sign; y a = by how much it is greater. Leaves the carry clear.
log_sum:
        cmp #10             ; from there on it is a byte
        bcs log_sum_far
        adc #>(log_sums)
        sta sums_at+1
        adc #24
        sta sums_up+1
        lda (sums_up),y
        tax
        lda (sums_at),y
        rts
log_sum_far:
        cmp #24
        bcc log_sum_byte
        jmp log_rest
log_sum_byte:
        adc #>(log_sums)
        sta sums_at+1
        ldx #0
        lda (sums_at),y
        rts
