set_sums:
        lda #<(log_sums)
        sta sums_at
        sta sums_up
        lda #<(log_sums+1)
        sta less_sums_at
        sta less_sums_up
        rts

; a x = low and high byte of what the greater of two logarithms grows by, in a sum of two
; values of one sign; y a = by how much it is greater. Leaves the carry clear.
log_sum:
        cmp #log_sums_pages
        bcs log_sum_slow
        adc #>(log_sums)
log_sum_both:
        sta sums_at+1
        adc #log_pages
        sta sums_up+1
        lda (sums_up),y
        tax
        lda (sums_at),y
        rts

; The same where y a is below 0: its complement is one less than its magnitude.
log_sum_less:
        eor #$ff
        cmp #log_sums_pages
        bcs log_sum_less_slow
        adc #>(log_sums+1)
        sta less_sums_at+1
        adc #log_pages
        sta less_sums_up+1
        tya
        eor #$ff
        tay
        lda (less_sums_up),y
        tax
        lda (less_sums_at),y
        rts
log_sum_none:               ; of 0, above all
        lda #0
        tax
        clc
        rts
; y is still as it was, and the page is complemented.
log_sum_less_slow:
        cmp #log_far_pages
        bcs log_sum_none
        tax
        tya
        eor #$ff
        tay
        txa
        iny                 ; the carry is clear
        bne log_sum_slow
        adc #1
; Behind the pages with upper bytes.
log_sum_slow:
