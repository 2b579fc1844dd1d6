; a and x (high) = a and prod+2, y bits to the right, rounded; y from 1 to 15.
lower24:                    ; at most 15 turns
        cmp #$80
        ror
        ror prod+2
        dey
        bne lower24
        bcc lower24_done
        inc prod+2
        bne lower24_done
        adc #0
lower24_done:
        tax
        lda prod+2
        rts
