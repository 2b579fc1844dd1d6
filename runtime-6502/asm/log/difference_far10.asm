; Behind the pages with upper bytes.
log_difference_far:
        cmp #24
        bcs log_difference_rest
        adc #>(log_lost)
        sta lost_at+1
        ldx #$ff
        lda (lost_at),y
        rts
log_difference_rest:
        jsr log_rest
        eor #$ff
        adc #1
        bcs log_difference_none
        dex
log_difference_none:
        clc
        rts
