; A sum or difference that was just made, low byte in x, high byte in a: what has left 16 bits is
; the number at that end, and what is left at the lower end has a negative.
saturate16:
        bvc saturate16_fits
        eor #$80            ; the sign that it has
        asl
        lda #$7f
        adc #0
        bmi saturate16_least
        ldx #$ff
        rts
saturate16_least:
        ldx #1
        rts
saturate16_fits:
        cmp #$80
        bne saturate16_done
        cpx #0
        bne saturate16_done
        inx
saturate16_done:
        rts
