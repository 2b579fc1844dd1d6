        cmp #48
        bcs log_difference_farther
        lsr
        tax
        tya
        ror
        tay
        txa
        clc
        adc #>(log_lost+3840)
        sta lost_at+1
        ldx #$ff
        lda (lost_at),y
        rts
log_difference_farther:
        cmp #log_far_pages
        bcs log_difference_none
        jsr log_sixteenth
        adc #>(log_lost+9984)
        sta lost_at+1
        ldx #$ff
        lda (lost_at),y
        rts
