; Of arg, which is above 0 and is shifted x bits to the left, to bit 23: 2^47 over that, in
; prod+3, prod+4 and prod+5.
reciprocal24:
        ldx #0
        lda arg+2
        bmi reciprocal24_look
        bne reciprocal24_up
reciprocal24_byte:
        txa
        clc
        adc #8
        tax
        ldy arg             ; eight bits at once
        lda arg+1
        sta arg+2
        sty arg+1
        ldy #0
        sty arg
        cmp #0
        bmi reciprocal24_look
        beq reciprocal24_byte
reciprocal24_up:
        inx
        asl arg
        rol arg+1
        rol
        bpl reciprocal24_up
        sta arg+2
reciprocal24_look:
        stx mixed
        lda arg
        asl
        sta part
        lda arg+1
        rol
        sta part+1
        lda arg+2
        rol
        tay
        sty prod+2
        lda reciprocals24_step0,y
        sta sum_hi
        eor #$ff
        sta dif_hi
        lda reciprocals24_step1,y
        sta sum1_lo
        sta sum1_hi
        eor #$ff
        sta dif1_lo
        sta dif1_hi
        jsr proportion24
        sta across
        ldy prod+2
        sec
        lda reciprocals24_0,y
        sbc across
        sta prod+3
        lda reciprocals24_1,y
        sbc above
        sta prod+4
        lda reciprocals24_2,y
        sbc #0
        sta prod+5
        jsr middle24        ; the product with arg is 2^47 and twice this less
        stx above
        asl
        rol above
        sta across
        sec
        lda #0
        sbc across
        sta across
        lda #0
        sbc above
        tax
        lda across
        ldy prod+5
        jsr correct24
        ldx mixed
        rts
