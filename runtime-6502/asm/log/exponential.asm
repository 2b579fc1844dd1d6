; acc = e to the power in acc.
log_exponential:
        lda acc+2
        pha
        clc
        lda acc
        adc #<(log_of_natural)
        sta acc
        lda acc+1
        adc #>(log_of_natural)
        bvc log_exponential_fits
        lda #$7f
log_exponential_fits:
        sta acc+1
        jsr log_units
        pla
; acc = the power of 2 of as many units as acc has, above 0 where a is 0, which fit.
log_power_of:
        tax
        lda #0
        sta acc+2
        txa
        beq log_power_above
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
log_power_above:
        rts
