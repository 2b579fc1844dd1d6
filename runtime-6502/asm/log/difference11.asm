set_lost:
        lda #<(log_lost)
        sta lost_at
        sta lost_up
        rts

; The same in a difference: what is added is below 0, for a difference of 0 by half of all.
log_difference:
        cmp #16
        bcs log_difference_far
        adc #>(log_lost)
log_difference_both:
        sta lost_at+1
        adc #36
        sta lost_up+1
        lda (lost_up),y
        tax
        lda (lost_at),y
        rts
log_difference_far:
        cmp #48
        bcs log_difference_farther
        lsr
        tax
        tya
        ror
        tay
        txa
        cmp #15             ; from there on the high byte is $ff
        bcs log_difference_byte
        adc #>(log_lost+2048)
        bcc log_difference_both
log_difference_byte:
        adc #>(log_lost+1792)
        sta lost_at+1
        ldx #$ff
        lda (lost_at),y
        rts
log_difference_farther:
        jsr log_sixteenth
        bcs log_difference_none
        adc #>(log_lost+8192)
        sta lost_at+1
        ldx #$ff
        lda (lost_at),y
        rts
log_difference_none:
        clc
        rts
