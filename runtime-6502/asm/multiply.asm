; prod = acc * arg, unsigned, 32 x 32 -> 64 bits.
; Row by row, as on paper, with bytes for digits: each byte of acc that is not 0
; times each byte of arg. A product plus two bytes always fits 16 bits.
multiply:
        lda #0
        sta prod
        sta prod+1
        sta prod+2
        sta prod+3
        sta prod+4
        sta prod+5
        sta prod+6
        sta prod+7
        tax                 ; which byte of acc
multiply_row:
        lda acc,x
        bne multiply_0
multiply_next:
        inx
        cpx #4
        bne multiply_row
        rts

multiply_0:
        sta sum_lo          ; the tables from f(a) on: y makes f(a + y)
        sta sum_hi
        eor #$ff
        sta dif_lo          ; and from f(-a) on: f(y - a)
        sta dif_hi
        lda #0
        sta carried
        ldy arg
        beq multiply_0_zero
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta low
        lda (sum_hi),y
        sbc (dif_hi),y
        tay
        lda low
        clc
        adc prod,x
        sta prod,x
        bcc multiply_0_done
        iny
multiply_0_done:
        sty carried
multiply_0_zero:
multiply_1:
        ldy arg+1
        beq multiply_1_zero
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta low
        lda (sum_hi),y
        sbc (dif_hi),y
        tay
        lda low
        clc
        adc carried
        bcc multiply_1_add
        iny
        clc
multiply_1_add:
        adc prod+1,x
        sta prod+1,x
        bcc multiply_1_done
        iny
multiply_1_done:
        sty carried
multiply_2:
        ldy arg+2
        beq multiply_2_zero
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta low
        lda (sum_hi),y
        sbc (dif_hi),y
        tay
        lda low
        clc
        adc carried
        bcc multiply_2_add
        iny
        clc
multiply_2_add:
        adc prod+2,x
        sta prod+2,x
        bcc multiply_2_done
        iny
multiply_2_done:
        sty carried
multiply_3:
        ldy arg+3
        beq multiply_3_zero
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta low
        lda (sum_hi),y
        sbc (dif_hi),y
        tay
        lda low
        clc
        adc carried
        bcc multiply_3_add
        iny
        clc
multiply_3_add:
        adc prod+3,x
        sta prod+3,x
        bcc multiply_3_done
        iny
multiply_3_done:
        sty carried
multiply_end:
        lda carried
        sta prod+4,x
        jmp multiply_next

multiply_1_zero:            ; y = 0
        lda carried
        clc
        adc prod+1,x
        sta prod+1,x
        bcc multiply_1_small
        iny
multiply_1_small:
        sty carried
        jmp multiply_2
multiply_2_zero:            ; y = 0
        lda carried
        clc
        adc prod+2,x
        sta prod+2,x
        bcc multiply_2_small
        iny
multiply_2_small:
        sty carried
        jmp multiply_3
multiply_3_zero:            ; y = 0
        lda carried
        clc
        adc prod+3,x
        sta prod+3,x
        bcc multiply_3_small
        iny
multiply_3_small:
        sty carried
        jmp multiply_end
