; acc y bits to the right, rounded; all of it if that is above 31.
right32:
        cpy #0
        beq right32_done
        cpy #32
        bcc right32_bit
        ldy #32
right32_bit:
        lda acc+3
        cmp #$80
        ror acc+3
        ror acc+2
        ror acc+1
        ror acc
        dey
        bne right32_bit
        bcc right32_done
        inc acc
        bne right32_done
        inc acc+1
        bne right32_done
        inc acc+2
        bne right32_done
        inc acc+3
right32_done:
        rts
