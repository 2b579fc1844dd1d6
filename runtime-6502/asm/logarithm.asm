; logarithm_sum, nine bytes = log2(acc) * logarithm_by, signed, with 32 bits
; more behind the point than logarithm_by, unsigned, has; acc is above 0, at
; most 2^31. With acc = 2^e m, 1 <= m < 2 and s = (m - 1)/(m + 1), the logarithm
; of m is 2s (c0 + c1 (2s)^2 + ...).
logarithm_times:
        ldy #14
        lda acc+3
logarithm_bytes:
        bne logarithm_high
        lda acc+2
        sta acc+3
        lda acc+1
        sta acc+2
        lda acc
        sta acc+1
        lda #0
        sta acc
        tya
        sec
        sbc #8
        tay
        lda acc+3
        jmp logarithm_bytes
logarithm_high:
        bpl logarithm_bits
        lsr acc+3           ; a zero falls out
        ror acc+2
        ror acc+1
        ror acc
        iny
        bne logarithm_ratio
logarithm_bits:
        bit acc+3
        bvs logarithm_ratio
        asl acc
        rol acc+1
        rol acc+2
        rol acc+3
        dey
        jmp logarithm_bits
logarithm_ratio:            ; acc = 2^30 m: from 2^30 (m - 1) and 2^29 (m + 1) comes 2s
        sty logarithm_power
        lda acc
        sta prod
        sta arg
        lda acc+1
        sta prod+1
        sta arg+1
        lda acc+2
        sta prod+2
        sta arg+2
        lda acc+3
        and #$3f
        sta prod+3
        lda acc+3
        clc
        adc #$40
        lsr
        sta arg+3
        ror arg+2
        ror arg+1
        ror arg
        lda #0
        sta acc
        sta acc+1
        sta acc+2
        sta acc+3
        jsr divide
        lda #<(logarithm_terms)
        sta terms
        lda #>(logarithm_terms)
        sta terms+1
        jsr odd_series
        asl prod+3
        ldx #0
        ldy #4
logarithm_fraction:         ; acc = log2 m, 0.32
        lda prod+4,x
        rol
        sta acc,x
        lda logarithm_by,x
        sta arg,x
        inx
        dey
        bne logarithm_fraction
        jsr multiply
        ldx #7
logarithm_keep:
        lda prod,x
        sta logarithm_sum,x
        dex
        bpl logarithm_keep
        lda #0
        sta acc+1
        sta acc+2
        sta acc+3
        lda logarithm_power
        bpl logarithm_whole
        eor #$ff
        clc
        adc #1
logarithm_whole:
        sta acc
        jsr multiply
        ldx #0
        ldy #4
        bit logarithm_power
        bmi logarithm_less
        clc
logarithm_more:
        lda logarithm_sum+4,x
        adc prod,x
        sta logarithm_sum+4,x
        inx
        dey
        bne logarithm_more
        lda prod+4
        adc #0
        sta logarithm_sum+8
        rts
logarithm_less:
        sec
logarithm_minus:
        lda logarithm_sum+4,x
        sbc prod,x
        sta logarithm_sum+4,x
        inx
        dey
        bne logarithm_minus
        lda #0
        sbc prod+4
        sta logarithm_sum+8
        rts
logarithm_power:
        .byte 0
logarithm_by:
        .byte 0, 0, 0, 0
logarithm_sum:
        .byte 0, 0, 0, 0, 0, 0, 0, 0, 0

; acc = the natural logarithm of acc in 16.16; of 0 and below the most negative.
logarithm:
        lda acc+3
        bmi logarithm_least
        ora acc+2
        ora acc+1
        ora acc
        beq logarithm_least
        lda #$f8            ; log2(a) ln(2)
        sta logarithm_by
        lda #$17
        sta logarithm_by+1
        lda #$72
        sta logarithm_by+2
        lda #$b1
        sta logarithm_by+3
        jsr logarithm_times
        asl logarithm_sum+5
        lda logarithm_sum+6
        adc #0
        sta acc
        lda logarithm_sum+7
        adc #0
        sta acc+1
        lda logarithm_sum+8
        adc #0
        sta acc+2
        asl
        lda #0
        sta acc+3
        bcc logarithm_done
        dec acc+3
logarithm_done:
        rts
logarithm_least:
        lda #$ff
        sta sign
        jmp saturate
