; acc = 2^(n + f) in 16.16, for f in prod+2 to prod+5, 0.32, and n in prod+6,
; signed. Carry: it is too large.
power_of_two:
        lda prod+6
        bmi power_of_two_below
        cmp #15
        bcs power_of_two_large
        bcc power_of_two_shift
power_of_two_below:
        cmp #$e0
        bcc power_of_two_small
power_of_two_shift:
        sec
        lda #15             ; 1.31 times 2^n is to be shifted down by 15 - n
        sbc prod+6
        sta power_of_two_by
        cmp #33
        bcs power_of_two_small
        ldx #3
power_of_two_copy:
        lda prod+2,x
        sta arg,x
        dex
        bpl power_of_two_copy
        lda #<(power_of_two_terms)
        sta terms
        lda #>(power_of_two_terms)
        sta terms+1
        jsr series
        ldx power_of_two_by
power_of_two_byte:
        cpx #9
        bcc power_of_two_bit
        lda acc+1
        sta acc
        lda acc+2
        sta acc+1
        lda acc+3
        sta acc+2
        lda #0
        sta acc+3
        txa
        sbc #8
        tax
        bne power_of_two_byte
power_of_two_bit:
        lsr acc+3
        ror acc+2
        ror acc+1
        ror acc
        dex
        bne power_of_two_bit
        lda acc
        adc #0
        sta acc
        lda acc+1
        adc #0
        sta acc+1
        lda acc+2
        adc #0
        sta acc+2
        lda acc+3
        adc #0
        sta acc+3
        asl
        rts
power_of_two_large:
        sec
        rts
power_of_two_small:
        lda #0
        sta acc
        sta acc+1
        sta acc+2
        sta acc+3
        clc
        rts
power_of_two_by:
        .byte 0
