; prod+3, prod+4 and a (high) = what is in prod+1 to prod+4 and a, 8 and y bits to the right,
; rounded; saturates.
round40_right:
        cmp #$80
        ror
        ror prod+4
        ror prod+3
        ror prod+2
        ror prod+1
        dey
        bne round40_right
round40:
        sta sign
        ldx prod+4          ; does the upper byte only repeat the sign?
        cpx #$80
        adc #0
        bne round40_large
        asl prod+1          ; the carry is what rounds
        lda prod+2
        adc #0
        tax
        lda prod+3
        adc #0
        tay
        lda prod+4
        adc #0
        bvs round40_large
        stx prod+3
        sty prod+4
        cmp #$80            ; the one number that has no negative
        beq round40_least_of_all
        rts
round40_least_of_all:
        jmp up24_least_of_all
round40_large:
        jmp up24_large
