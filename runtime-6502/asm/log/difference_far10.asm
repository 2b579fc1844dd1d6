        cmp #24
        bcs log_difference_rest
        adc #>(log_lost)
        sta lost_at+1
        ldx #$ff
        lda (lost_at),y
        rts
log_difference_rest:
        cmp #log_far_pages
        bcs log_difference_none
        jsr log_rest
        eor #$ff
        adc #1
        bcs log_difference_rested
        dex
log_difference_rested:
        clc
        rts
