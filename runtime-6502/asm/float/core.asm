; fa = the real of the mantissa in fa and float_guard, which need not have its leading bit, and
; of float_exp and float_sign.
float_normal:
        lda fa+3
        bmi float_round
        bne float_normal_bits
        ldx #5
float_normal_bytes:
        dex
        beq float_zero
        lda fa+2
        sta fa+3
        lda fa+1
        sta fa+2
        lda fa
        sta fa+1
        lda float_guard
        sta fa
        lda #0
        sta float_guard
        sec
        lda float_exp
        sbc #8
        sta float_exp
        bcs float_normal_next
        dec float_exp+1
float_normal_next:
        lda fa+3
        beq float_normal_bytes
        bmi float_round
float_normal_bits:
        ldy #0
float_normal_bit:
        iny
        asl float_guard
        rol fa
        rol fa+1
        rol fa+2
        rol
        bpl float_normal_bit
        sta fa+3
        sty float_n
        sec
        lda float_exp
        sbc float_n
        sta float_exp
        bcs float_round
        dec float_exp+1
; The same of one that has its leading bit: to the nearest.
float_round:
        lda float_guard
        bpl float_pack
        inc fa
        bne float_pack
        inc fa+1
        bne float_pack
        inc fa+2
        bne float_pack
        inc fa+3
        bne float_pack
        lda #$80
        sta fa+3
        inc float_exp
        bne float_pack
        inc float_exp+1
; The same without rounding.
float_pack:
        lda float_exp+1
        bne float_far
        lda float_exp
        beq float_zero
        sta fa+4
        lda float_sign
        ora #$7f
        and fa+3
        sta fa+3
        rts
float_far:
        bpl float_most
float_zero:
        lda #0
        sta fa
        sta fa+1
        sta fa+2
        sta fa+3
        sta fa+4
        rts
; fa = the greatest, or its opposite, by float_sign.
float_most:
        lda #$ff
        sta fa
        sta fa+1
        sta fa+2
        sta fa+4
        lda float_sign
        ora #$7f
        sta fa+3
        rts

; fb, fa = fa
float_to_second:
        ldx #4
float_to_second_byte:
        lda fa,x
        sta fb,x
        dex
        bpl float_to_second_byte
        rts
; fa = fb
float_to_first:
        ldx #4
float_to_first_byte:
        lda fb,x
        sta fa,x
        dex
        bpl float_to_first_byte
        rts
; float_x = fa
float_keep:
        ldx #4
float_keep_byte:
        lda fa,x
        sta float_x,x
        dex
        bpl float_keep_byte
        rts
; fb = 1
float_one:
        lda #0
        sta fb
        sta fb+1
        sta fb+2
        sta fb+3
        lda #129
        sta fb+4
        rts
; fa = -fa
float_negate:
        lda fa+4
        beq float_negate_zero
        lda fa+3
        eor #$80
        sta fa+3
float_negate_zero:
        rts
