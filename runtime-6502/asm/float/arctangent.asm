; fa = the angle of (y, x) = (fa, fb); of (0, 0) it is 0
float_arctangent2:
        lda fa+3
        sta float_arc_below
        and #$7f
        sta fa+3
        lda fb+3
        sta float_arc_left
        and #$7f
        sta fb+3
        lda fb              ; the lesser over the greater
        cmp fa
        lda fb+1
        sbc fa+1
        lda fb+2
        sbc fa+2
        lda fb+3
        sbc fa+3
        lda fb+4
        sbc fa+4
        ror float_arc_flat
        bmi float_arc_ratio
        ldx #4
float_arc_swap:
        lda fa,x
        ldy fb,x
        sta fb,x
        sty fa,x
        dex
        bpl float_arc_swap
float_arc_ratio:
        lda fb+4
        bne float_arc_somewhere
        rts
float_arc_somewhere:
        jsr float_divide
        lda #0
        sta float_sign
        lda #<(float_arctangent_terms)
        sta float_at
        lda #>(float_arctangent_terms)
        sta float_at+1
        jsr float_odd
        bit float_arc_flat
        bmi float_arc_side
        ldx #129            ; from pi/2
        jsr float_arc_from
float_arc_side:
        bit float_arc_left
        bpl float_arc_sign
        ldx #130            ; from pi
        jsr float_arc_from
float_arc_sign:
        bit float_arc_below
        bpl float_arc_done
        jmp float_negate
float_arc_done:
        rts
; fa = pi, or pi/2, by the exponent x, less fa
float_arc_from:
        stx fb+4
        lda #$a2
        sta fb
        lda #$da
        sta fb+1
        lda #$0f
        sta fb+2
        lda #$49
        sta fb+3
        jsr float_negate
        jmp float_add
float_arc_below:
        .byte 0
float_arc_left:
        .byte 0
float_arc_flat:
        .byte 0
