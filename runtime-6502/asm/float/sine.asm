; fa = the cosine of fa, or its sine
float_cosine:
        ldx #1
        bne float_sine_of
float_sine:
        ldx #0
        bit fa+3
        bpl float_sine_of
        ldx #2
float_sine_of:
        stx float_quad
        lda fa+4
        beq float_sine_none
        cmp #168
        bcc float_sine_product
float_sine_none:            ; nothing is left of the angle, or of its place in a turn
        lda #0
        sta prod+3
        sta prod+4
        sta prod+5
        sta prod+6
        sta prod+7
        lda #128
        sta fa+4
        bne float_sine_quadrant
float_sine_product:
        lda fa+3
        ora #$80
        sta fa+3
        lda #$6e            ; over pi/2
        sta fb
        lda #$83
        sta fb+1
        lda #$f9
        sta fb+2
        lda #$a2
        sta fb+3
        jsr float_product
        lda fa+4
        cmp #129
        bcc float_sine_quadrant
        sbc #128
        tax
        lda #0
        sta float_n
float_sine_turn:
        asl prod+3
        rol prod+4
        rol prod+5
        rol prod+6
        rol prod+7
        rol float_n
        dex
        bne float_sine_turn
        clc
        lda float_n
        adc float_quad
        sta float_quad
        lda #128
        sta fa+4
float_sine_quadrant:        ; prod+3 and so on, of the exponent in fa+4
        lda fa+4
        sta float_exp
        lda #0
        sta float_exp+1
        lda prod+3
        sta float_guard
        ldx #3
float_sine_place:
        lda prod+4,x
        sta fa,x
        dex
        bpl float_sine_place
        lsr float_quad
        bcc float_sine_even
        lda #128            ; from the other end
        sec
        sbc float_exp
        jsr float_shift_fa
        lda #128
        sta float_exp
        ldx #3
float_sine_flip:
        lda fa,x
        eor #$ff
        sta fa,x
        dex
        bpl float_sine_flip
        lda float_guard
        eor #$ff
        sta float_guard
float_sine_even:
        lda #0
        sta float_sign
        jsr float_normal
        lda #0
        lsr float_quad
        ror
        sta float_sign
        lda #<(float_sine_terms)
        sta float_at
        lda #>(float_sine_terms)
        sta float_at+1
        jmp float_odd
