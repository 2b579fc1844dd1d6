; fa = the polynomial that float_at points to at fb, 32 bits behind the point: 31 behind it, with
; its leading bit. Each term is exclusive-or the mask, where signs alternate.
float_series:
        ldy #0
        lda (float_at),y
        sta float_n
        iny
        lda (float_at),y
        sta float_mask
        ldx #0
float_series_first:
        iny
        lda (float_at),y
        eor float_mask
        sta fa,x
        inx
        cpx #4
        bne float_series_first
        iny
float_series_term:
        sty float_y
        jsr float_product
        ldy float_y
        clc
        lda (float_at),y
        adc prod+4
        eor float_mask
        sta fa
        iny
        lda (float_at),y
        adc prod+5
        eor float_mask
        sta fa+1
        iny
        lda (float_at),y
        adc prod+6
        eor float_mask
        sta fa+2
        iny
        lda (float_at),y
        adc prod+7
        eor float_mask
        sta fa+3
        iny
        dec float_n
        bne float_series_term
        rts

; fa = x P(x x) of the x from 0 to 1 in fa, whose sign float_sign becomes.
float_odd:
        lda fa+4
        bne float_odd_some
        rts
float_odd_some:
        lda fa+3
        ora #$80
        sta fa+3
        lda #0
        sta float_guard
        lda fa+4
        cmp #129
        bcc float_odd_less
        lda #$ff            ; 1: as near to it as it comes
        sta fa
        sta fa+1
        sta fa+2
        sta fa+3
        lda #128
float_odd_less:
        sta float_exp
        jsr float_keep
        jsr float_to_second
        jsr float_product
        ldx #3
float_odd_square:
        lda prod+4,x
        sta fb,x
        dex
        bpl float_odd_square
        sec
        lda #128
        sbc float_exp
        asl
        jsr float_shift_fb
        jsr float_series
        ldx #3
float_odd_factor:
        lda float_x,x
        sta fb,x
        dex
        bpl float_odd_factor
        lda #0
        sta float_exp+1
        inc float_exp       ; at most 129
        jsr float_product
        lda prod+3
        sta float_guard
        ldx #3
float_odd_place:
        lda prod+4,x
        sta fa,x
        dex
        bpl float_odd_place
        jmp float_normal
