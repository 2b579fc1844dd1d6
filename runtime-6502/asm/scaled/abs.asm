; The magnitude of a and x (high).
abs16:
        cpx #$80
        bcc abs16_done
        eor #$ff
        adc #0              ; the carry is set
        sta acc
        txa
        eor #$ff
        adc #0
        tax
        lda acc
abs16_done:
        rts
