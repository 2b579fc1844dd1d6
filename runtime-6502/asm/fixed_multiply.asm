; acc = acc * arg in 16.16, to the nearest, halves away from zero; saturates.
fixed_multiply:
        jsr magnitudes
        jsr multiply
        lda prod+6
        ora prod+7
        bne fixed_multiply_large
        asl prod+1          ; the bit below the last place
        lda prod+2
        adc #0
        sta acc
        lda prod+3
        adc #0
        sta acc+1
        lda prod+4
        adc #0
        sta acc+2
        lda prod+5
        adc #0
        sta acc+3
        bcs fixed_multiply_large
        bmi fixed_multiply_large
        bit sign
        bmi fixed_multiply_negative
        rts
fixed_multiply_negative:
        jmp negate
fixed_multiply_large:
        jmp saturate
