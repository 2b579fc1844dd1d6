; prod+3, prod+4 and a (high), y bits to the right, rounded; y from 1 to 24.
lower32:
        cpy #9
        bcc lower32_bit
        ldx prod+4          ; a whole byte
        stx prod+3
        sta prod+4
        cmp #$80
        lda #0
        adc #$ff
        eor #$ff
        sta prod+5
        tya
        sec
        sbc #8
        tay
        lda prod+5
        jmp lower32
lower32_bit:
        cmp #$80
        ror
        ror prod+4
        ror prod+3
        dey
        bne lower32_bit
        bcc lower32_done
        inc prod+3
        bne lower32_done
        inc prod+4
        bne lower32_done
        adc #0
lower32_done:
        rts
