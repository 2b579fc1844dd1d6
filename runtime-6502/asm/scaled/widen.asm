; acc = the number of 16 bits in a and x (high), y bits to the left; saturates.
widen:
        sta acc
        stx acc+1
        ldx #0
        lda acc+1
        bpl widen_sign
        dex
widen_sign:
        stx acc+2
        stx acc+3
widen_bits:
        cpy #0
        beq widen_done
widen_bit:
        asl acc
        rol acc+1
        rol acc+2
        rol acc+3
        txa
        eor acc+3
        bmi widen_large
        dey
        bne widen_bit
widen_done:
        rts
widen_large:
        stx sign
        jmp saturate

; acc = the number of 16 bits in a and x (high), y bits to the right, rounded.
widen_right:
        sta acc
        stx acc+1
        ldx #0
        lda acc+1
        bpl widen_right_sign
        dex
widen_right_sign:
        stx acc+2
        stx acc+3
        jmp right32
