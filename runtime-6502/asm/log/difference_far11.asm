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
        cmp #log_far_pages
        bcs log_difference_none
        jsr log_sixteenth
        adc #>(log_lost+8192)
        sta lost_at+1
        ldx #$ff
        lda (lost_at),y
        rts
