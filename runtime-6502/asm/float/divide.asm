; fa = fa / fb, by 0 the greatest
float_divide:
        lda fa+4
        beq float_divide_zero
        lda fa+3
        tax
        eor fb+3
        sta float_sign
        lda fb+4
        bne float_divide_by
        stx float_sign
        jmp float_most
float_divide_zero:
        rts
float_divide_by:
        txa
        ora #$80
        sta fa+3
        lda fb+3
        ora #$80
        sta fb+3
        ldx #0
        stx float_exp+1
        clc                 ; the exponents' difference and 128, and 1 where the first is not less
        lda fa+4
        adc #128
        bcc float_divide_low
        inc float_exp+1
float_divide_low:
        sec
        sbc fb+4
        sta float_exp
        bcs float_divide_compare
        dec float_exp+1
float_divide_compare:
        lda fa
        sta prod
        cmp fb
        lda fa+1
        sta prod+1
        sbc fb+1
        lda fa+2
        sta prod+2
        sbc fb+2
        lda fa+3
        sta prod+3
        sbc fb+3
        lda prod+3
        bcc float_divide_double
        inc float_exp
        bne float_divide_whole
        inc float_exp+1
float_divide_whole:
        clc
        bcc float_divide_start
float_divide_double:
        asl prod
        rol prod+1
        rol prod+2
        rol
float_divide_start:
        ldx #3
        ldy #8
float_divide_bit:           ; a and prod, of 33 bits with the carry: what is left
        bcs float_divide_take
        cmp fb+3
        bcc float_divide_shift
        bne float_divide_take
        sta prod+3
        lda prod+2
        cmp fb+2
        bne float_divide_told
        lda prod+1
        cmp fb+1
        bne float_divide_told
        lda prod
        cmp fb
float_divide_told:
        lda prod+3
        bcc float_divide_shift
float_divide_take:
        sec
        sta prod+3
        lda prod
        sbc fb
        sta prod
        lda prod+1
        sbc fb+1
        sta prod+1
        lda prod+2
        sbc fb+2
        sta prod+2
        lda prod+3
        sbc fb+3
        sec
float_divide_shift:
        rol bits
        asl prod
        rol prod+1
        rol prod+2
        rol
        dey
        bne float_divide_bit
        sta prod+3
        lda bits
        sta fa,x
        lda prod+3
        ldy #8
        dex
        bpl float_divide_bit
        bcs float_divide_up
        lda prod
        cmp fb
        lda prod+1
        sbc fb+1
        lda prod+2
        sbc fb+2
        lda prod+3
        sbc fb+3
float_divide_up:
        ror float_guard
        jmp float_round
