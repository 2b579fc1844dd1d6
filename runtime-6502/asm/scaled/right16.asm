; a and x (high), y bits to the right, one at least, rounded.
right16:
        sta acc
        txa
right16_bit:
        cmp #$80
        ror
        ror acc
        dey
        bne right16_bit
        tax
        bcc right16_done
        inc acc
        bne right16_done
        inx
right16_done:
        lda acc
        rts
