; fa = fa * fb
float_multiply:
        lda fa+4
        beq float_multiply_zero
        ldx fb+4
        beq float_multiply_none
        clc                 ; the sum of the exponents less 128
        adc fb+4
        ldx #0
        bcs float_multiply_high
        eor #$80
        bpl float_multiply_exp
        dex
        bmi float_multiply_exp
float_multiply_high:
        eor #$80
        bmi float_multiply_exp
        inx
float_multiply_exp:
        sta float_exp
        stx float_exp+1
        lda fa+3
        tax
        eor fb+3
        sta float_sign
        txa
        ora #$80
        sta fa+3
        lda fb+3
        ora #$80
        sta fb+3
        jsr float_product
        lda prod+7
        bmi float_multiply_whole
        asl prod+3
        rol prod+4
        rol prod+5
        rol prod+6
        rol
        ldx float_exp
        bne float_multiply_less
        dec float_exp+1
float_multiply_less:
        dec float_exp
float_multiply_whole:
        sta fa+3
        lda prod+6
        sta fa+2
        lda prod+5
        sta fa+1
        lda prod+4
        sta fa
        lda prod+3
        sta float_guard
        jmp float_round
float_multiply_none:
        jmp float_zero
float_multiply_zero:
        rts
