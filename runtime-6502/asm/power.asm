; acc = acc^arg in 16.16, as 2^(arg log2(acc)); saturates. x^0 is 1, 0 to a
; negative the largest value, a negative to a fraction 0.
power_of_zero:
        sta sign
        bit power_below
        bpl power_zero
        jmp saturate
power_zero:
        jmp power_of_two_small
power_one:
        sta acc
        sta acc+1
        sta acc+3
        lda #1
        sta acc+2
        rts
power:
        lda arg
        ora arg+1
        ora arg+2
        ora arg+3
        beq power_one
        lda arg+3
        sta power_below
        lda acc
        ora acc+1
        ora acc+2
        ora acc+3
        beq power_of_zero
        lda acc+3
        sta sign            ; a negative to an odd number is negative
        bpl power_positive
        lda arg
        ora arg+1
        bne power_zero
        lda arg+2
        lsr
        ror
        sta sign
        jsr negate
power_positive:
        lda sign
        sta power_sign
        bit power_below     ; the magnitude of arg
        bpl power_up
        ldx #0
        ldy #4
        sec
power_magnitude:
        lda #0
        sbc arg,x
        sta arg,x
        inx
        dey
        bne power_magnitude
power_up:
        ldx #3
power_by:
        lda arg,x
        sta logarithm_by,x
        dex
        bpl power_by
        jsr logarithm_times
        ldx #6
power_copy:
        lda logarithm_sum+2,x
        bit power_below
        bpl power_as_it_is
        eor #$ff
power_as_it_is:
        sta power_exponent,x
        dex
        bpl power_copy
        lda power_exponent+4
        asl                 ; the bytes above must repeat its sign
        lda #$ff
        adc #0
        eor #$ff
        cmp power_exponent+5
        bne power_far
        cmp power_exponent+6
        bne power_far
        ldx #4
power_place:
        lda power_exponent,x
        sta prod+2,x
        dex
        bpl power_place
        jsr power_of_two
        bcs power_large
        bit power_sign
        bmi power_negative
        rts
power_negative:
        jmp negate
power_far:
        lda power_exponent+6
        bpl power_large
        jmp power_of_two_small
power_large:
        lda power_sign
        sta sign
        jmp saturate
power_below:
        .byte 0
power_sign:
        .byte 0
power_exponent:
        .byte 0, 0, 0, 0, 0, 0, 0
