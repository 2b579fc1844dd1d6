; prod+3, prod+4 and a (high) = the root of acc, of 24 bits, times 2 to the y; y is 24 less
; that, halved, or 25 where root24_odd is called.
root24_odd:
        lda acc+2
        bmi root24_zero
        asl acc
        rol acc+1
        rol
        jmp root24_begin
root24:
        lda acc+2
        bmi root24_zero
root24_begin:
        sty count           ; halvings of the result that are left
        tax
        bne root24_scale
        lda acc+1           ; eight bits at once
        ldx acc
        bne root24_byte
        tay
        beq root24_zero
root24_byte:
        stx acc+1
        ldx #0
        stx acc
        tax
        lda count
        clc
        adc #4
        sta count
        txa
        bne root24_scale
        lda acc+1           ; and once more
        stx acc+1
        ldx count
        inx
        inx
        inx
        inx
        stx count
root24_scale:
        cmp #$40
        bcs root24_look
        asl acc
        rol acc+1
        rol
        asl acc
        rol acc+1
        rol
        inc count
        bne root24_scale
root24_zero:
        lda #0
        sta prod+3
        sta prod+4
        rts
root24_look:
        tay
        sty acc+2
        lda acc
        sta part
        lda acc+1
        sta part+1
        lda roots24_step0-64,y
        sta sum_hi
        eor #$ff
        sta dif_hi
        lda roots24_step1-64,y
        sta sum1_lo
        sta sum1_hi
        eor #$ff
        sta dif1_lo
        sta dif1_hi
        jsr proportion24
        ldy acc+2
        clc
        adc roots24_0-64,y
        sta prod+3
        sta arg
        lda above
        adc roots24_1-64,y
        sta prod+4
        sta arg+1
        lda roots24_2-64,y
        adc #0
        sta prod+5
        sta arg+2
        jsr middle24        ; its square is too small by what acc has more
        stx across
        sta above
        sec
        lda #0
        sbc above
        tay
        lda acc
        sbc across
        tax
        tya
        ldy acc+2
        sta acc+1
        lda roots24_inverse-64,y
        tay
        lda acc+1
        jsr correct24
        ldy count
        lda prod+5
root24_half:
        lsr
        ror prod+4
        ror prod+3
        dey
        bne root24_half
        bcc root24_done
        inc prod+3
        bne root24_done
        inc prod+4
        bne root24_done
        clc
        adc #1
        bpl root24_done
        lda #$ff
        sta prod+3
        sta prod+4
        lda #$7f
root24_done:
        rts
