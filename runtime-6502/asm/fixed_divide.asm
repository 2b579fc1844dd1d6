; acc = acc / arg in 16.16, to the nearest, halves away from zero; saturates,
; x / 0 too; 0 / 0 is 0.
fixed_divide:
        lda arg
        ora arg+1
        ora arg+2
        ora arg+3
        bne fixed_divide_do
        jmp divide_by_zero
fixed_divide_do:
        jsr magnitudes
        lda acc+2           ; the dividend is acc * 65536
        sta prod
        lda acc+3
        sta prod+1
        lda acc+1
        sta acc+3
        lda acc
        sta acc+2
        lda #0
        sta prod+2
        sta prod+3
        sta acc
        sta acc+1
        lda arg+3           ; does the quotient fit 32 bits?
        ora arg+2
        bne fixed_divide_fits
        lda prod
        cmp arg
        lda prod+1
        sbc arg+1
        bcs fixed_divide_large
fixed_divide_fits:
        jsr divide
        asl prod            ; is the remainder half of arg or more?
        rol prod+1
        rol prod+2
        rol prod+3
        lda prod
        cmp arg
        lda prod+1
        sbc arg+1
        lda prod+2
        sbc arg+2
        lda prod+3
        sbc arg+3
        bcc fixed_divide_down
        inc acc
        bne fixed_divide_down
        inc acc+1
        bne fixed_divide_down
        inc acc+2
        bne fixed_divide_down
        inc acc+3
        beq fixed_divide_large
fixed_divide_down:
        lda acc+3
        bmi fixed_divide_large
        jmp signed
fixed_divide_large:
        jmp saturate
