; prod+3 to prod+7 = the upper 40 of the 64 bits of the product of the mantissas fa and fb. Of
; what is below, nothing; of the column before the lowest of these, upper bytes alone, and these
; as if nothing were borrowed: at most 3 too much, 3/128 of a last place of 32 bits.
float_product:
        lda fa+3
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy fb
        sec                 ; as all differences of squares leave it
        lda (sum_lo),y
        sbc (dif_lo),y
        sta prod+3
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+4
        ldy fb+1
        lda (sum_lo),y
        sbc (dif_lo),y
        sta float_t
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+5
        ldy fb+2
        lda (sum_lo),y
        sbc (dif_lo),y
        sta float_t+1
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+6
        ldy fb+3
        lda (sum_lo),y
        sbc (dif_lo),y
        sta float_t+2
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+7
        clc
        lda float_t
        adc prod+4
        sta prod+4
        lda float_t+1
        adc prod+5
        sta prod+5
        lda float_t+2
        adc prod+6
        sta prod+6
        bcc float_product_2
        inc prod+7
float_product_2:
        lda fa+2
        bne float_product_2x
        jmp float_product_1
float_product_2x:
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy fb
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        sta float_u
        ldy fb+1
        lda (sum_lo),y
        sbc (dif_lo),y
        sta float_t
        lda (sum_hi),y
        sbc (dif_hi),y
        sta float_u+1
        ldy fb+2
        lda (sum_lo),y
        sbc (dif_lo),y
        sta float_t+1
        lda (sum_hi),y
        sbc (dif_hi),y
        sta float_u+2
        ldy fb+3
        lda (sum_lo),y
        sbc (dif_lo),y
        sta float_t+2
        lda (sum_hi),y
        sbc (dif_hi),y
        sta float_u+3
        clc
        lda float_t
        adc prod+3
        sta prod+3
        lda float_t+1
        adc prod+4
        sta prod+4
        lda float_t+2
        adc prod+5
        sta prod+5
        bcc float_product_2a
        inc prod+6
        bne float_product_2a
        inc prod+7
float_product_2a:
        clc
        lda float_u
        adc prod+3
        sta prod+3
        lda float_u+1
        adc prod+4
        sta prod+4
        lda float_u+2
        adc prod+5
        sta prod+5
        lda float_u+3
        adc prod+6
        sta prod+6
        bcc float_product_1
        inc prod+7
float_product_1:
        lda fa+1
        bne float_product_1x
        jmp float_product_0
float_product_1x:
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy fb+1
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        sta float_u
        ldy fb+2
        lda (sum_lo),y
        sbc (dif_lo),y
        sta float_t
        lda (sum_hi),y
        sbc (dif_hi),y
        sta float_u+1
        ldy fb+3
        lda (sum_lo),y
        sbc (dif_lo),y
        sta float_t+1
        lda (sum_hi),y
        sbc (dif_hi),y
        sta float_u+2
        clc
        lda float_t
        adc prod+3
        sta prod+3
        lda float_t+1
        adc prod+4
        sta prod+4
        bcc float_product_1a
        inc prod+5
        bne float_product_1a
        inc prod+6
        bne float_product_1a
        inc prod+7
float_product_1a:
        clc
        lda float_u
        adc prod+3
        sta prod+3
        lda float_u+1
        adc prod+4
        sta prod+4
        lda float_u+2
        adc prod+5
        sta prod+5
        bcc float_product_0
        inc prod+6
        bne float_product_0
        inc prod+7
float_product_0:
        lda fa
        beq float_product_done
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy fb+2
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        sta float_u
        ldy fb+3
        lda (sum_lo),y
        sbc (dif_lo),y
        sta float_t
        lda (sum_hi),y
        sbc (dif_hi),y
        sta float_u+1
        clc
        lda float_t
        adc prod+3
        sta prod+3
        bcc float_product_0a
        inc prod+4
        bne float_product_0a
        inc prod+5
        bne float_product_0a
        inc prod+6
        bne float_product_0a
        inc prod+7
float_product_0a:
        clc
        lda float_u
        adc prod+3
        sta prod+3
        lda float_u+1
        adc prod+4
        sta prod+4
        bcc float_product_done
        inc prod+5
        bne float_product_done
        inc prod+6
        bne float_product_done
        inc prod+7
float_product_done:
        rts
