set_sums:
        lda #<(log_sums)
        sta sums_at
        sta sums_up
        rts

; a x = low and high byte of what the greater of two logarithms grows by, in a sum of two
; values of one sign; y a = by how much it is greater. Leaves the carry clear.
log_sum:
        cmp #16             ; two octaves: an entry for each
        bcs log_sum_far
        adc #>(log_sums)
log_sum_both:
        sta sums_at+1
        adc #36
        sta sums_up+1
        lda (sums_up),y
        tax
        lda (sums_at),y
        rts
log_sum_far:
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
        jsr log_sixteenth   ; one for sixteen
        bcs log_sum_none
        adc #>(log_sums+8192)
        sta sums_at+1
        lda (sums_at),y
        rts
log_sum_none:
        clc
        rts
