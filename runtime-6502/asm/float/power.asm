; fa = fa^fb; x^0 is 1, a negative to a fraction 0
float_power:
        lda fb+4
        bne float_power_some
        jsr float_one
        jmp float_to_first
float_power_some:
        lda fa+4
        bne float_power_of
        lda #0              ; of 0
        sta float_sign
        bit fb+3
        bpl float_power_zero
        jmp float_most
float_power_zero:
        rts
float_power_of:
        ldx #0
        stx float_power_sign
        lda fa+3
        bpl float_power_plus
        and #$7f
        sta fa+3
        lda fb              ; is the exponent whole, and even?
        sta float_x
        lda fb+1
        sta float_x+1
        lda fb+2
        sta float_x+2
        lda fb+3
        ora #$80
        sta float_x+3
        lda fb+4
        cmp #161
        bcs float_power_plus
        sec
        sbc #128
        bcc float_power_none
        beq float_power_none
        tay
float_power_whole:
        asl float_x
        rol float_x+1
        rol float_x+2
        rol float_x+3
        dey
        bne float_power_whole
        ror float_power_sign
        lda float_x
        ora float_x+1
        ora float_x+2
        ora float_x+3
        beq float_power_plus
float_power_none:
        jmp float_zero
float_power_plus:
        ldx #4
float_power_keep:
        lda fb,x
        sta float_power_by,x
        dex
        bpl float_power_keep
        jsr float_logarithm
        ldx #4
float_power_place:
        lda float_power_by,x
        sta fb,x
        dex
        bpl float_power_place
        jsr float_multiply
        jsr float_exponential
        bit float_power_sign
        bmi float_power_minus
        rts
float_power_minus:
        jmp float_negate
float_power_sign:
        .byte 0
float_power_by:
        .byte 0, 0, 0, 0, 0
