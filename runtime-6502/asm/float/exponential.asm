; fa = e^fa
float_exponential:
        lda fa+3
        sta float_sign
        lda fa+4
        bne float_exp_some
        jsr float_one
        jmp float_to_first
float_exp_some:
        cmp #136
        bcc float_exp_near
        bit float_sign
        bmi float_exp_none
        jmp float_most
float_exp_none:
        jmp float_zero
float_exp_near:
        lda fa+3
        ora #$80
        sta fa+3
        lda #$29            ; times log2(e)
        sta fb
        lda #$3b
        sta fb+1
        lda #$aa
        sta fb+2
        lda #$b8
        sta fb+3
        jsr float_product
        lda prod+3
        sta float_guard
        ldx #3
float_exp_place:
        lda prod+4,x
        sta fb,x
        dex
        bpl float_exp_place
        lda #0
        sta float_quad
        lda fa+4
        sec
        sbc #127
        bcc float_exp_right
        beq float_exp_placed
        tax
float_exp_left:
        asl float_guard
        rol fb
        rol fb+1
        rol fb+2
        rol fb+3
        rol float_quad
        dex
        bne float_exp_left
        beq float_exp_placed
float_exp_right:
        eor #$ff
        adc #1
        jsr float_shift_fb
float_exp_placed:
        lda #129
        bit float_sign
        bpl float_exp_up
        ldx #3
float_exp_flip:
        lda fb,x
        eor #$ff
        sta fb,x
        dex
        bpl float_exp_flip
        lda #128            ; less the whole part
        sec
        sbc float_quad
        sta float_exp
        lda #0
        sbc #0
        jmp float_exp_series
float_exp_up:
        clc
        adc float_quad
        sta float_exp
        lda #0
        rol
float_exp_series:
        sta float_exp+1
        lda #<(float_exponential_terms)
        sta float_at
        lda #>(float_exponential_terms)
        sta float_at+1
        jsr float_series
        lda fa+3
        bmi float_exp_pack
        lda #$ff            ; just below 2
        sta fa
        sta fa+1
        sta fa+2
        sta fa+3
float_exp_pack:
        lda #0
        sta float_sign
        jmp float_pack
