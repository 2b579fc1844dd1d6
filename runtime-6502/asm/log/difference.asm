set_lost:
        lda #<(log_lost)
        sta lost_at
        sta lost_up
        lda #<(log_lost+1)
        sta less_lost_at
        sta less_lost_up
        rts

; What is added in a difference, which is below 0; y a = by how much the first logarithm is
; greater, less 1.
log_difference:
        cmp #log_lost_pages
        bcs log_difference_slow
        adc #>(log_lost+1)
        sta less_lost_at+1
        adc #log_pages
        sta less_lost_up+1
        lda (less_lost_up),y
        tax
        lda (less_lost_at),y
        rts
log_difference_slow:
        iny                 ; the carry is set
        bne log_difference_far
        adc #0
        bne log_difference_far
log_difference_none:        ; of 0, above all
        lda #0
        tax
        clc
        rts

; The same where that is below 0, and x = 1 where the two are equal.
log_difference_less:
        eor #$ff
        cmp #log_lost_pages
        bcs log_difference_less_slow
        tax
        tya
        eor #$ff
        tay
        txa
        adc #>(log_lost)
log_difference_both:
        sta lost_at+1
        adc #log_pages
        sta lost_up+1
        lda (lost_up),y
        tax
        lda (lost_at),y
        rts
; y is still as it was, and the page is complemented.
log_difference_less_slow:
        cmp #log_far_pages
        bcs log_difference_none
        tax
        tya
        eor #$ff
        tay
        txa
; Behind the pages with upper bytes.
log_difference_far:
