; Behind the pages with upper bytes.
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
