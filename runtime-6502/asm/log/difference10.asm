set_lost:
        lda #<(log_lost)
        sta lost_at
        sta lost_up
        rts

; The same in a difference: what is added is below 0, for a difference of 0 by half of all.
log_difference:
        cmp #11             ; from there on the high byte is $ff
        bcs log_difference_far
        adc #>(log_lost)
        sta lost_at+1
        adc #24
        sta lost_up+1
        lda (lost_up),y
        tax
        lda (lost_at),y
        rts
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
