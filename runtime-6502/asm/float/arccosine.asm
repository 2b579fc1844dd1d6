; fa = the angle of a cosine, or of a sine, clamped to -1..1
float_arccosine:
        jsr float_arc_other
        ldx #4
float_arccosine_x:
        lda float_arc_x,x
        sta fb,x
        dex
        bpl float_arccosine_x
        jmp float_arctangent2
float_arcsine:
        jsr float_arc_other
        jsr float_to_second
        ldx #4
float_arcsine_x:
        lda float_arc_x,x
        sta fa,x
        dex
        bpl float_arcsine_x
        jmp float_arctangent2
; fa = the root of (1 + x)(1 - x), float_arc_x = x
float_arc_other:
        lda fa+4
        cmp #129
        bcc float_arc_within
        lda #0
        sta fa
        sta fa+1
        sta fa+2
        lda fa+3
        and #$80
        sta fa+3
        lda #129
        sta fa+4
float_arc_within:
        ldx #4
float_arc_keep:
        lda fa,x
        sta float_arc_x,x
        dex
        bpl float_arc_keep
        jsr float_one
        jsr float_add
        ldx #4
float_arc_place:
        lda float_arc_x,x
        tay
        lda fa,x
        sta float_arc_up,x
        sty fa,x
        dex
        bpl float_arc_place
        jsr float_negate
        jsr float_one
        jsr float_add
        ldx #4
float_arc_by:
        lda float_arc_up,x
        sta fb,x
        dex
        bpl float_arc_by
        jsr float_multiply
        jmp float_root
float_arc_x:
        .byte 0, 0, 0, 0, 0
float_arc_up:
        .byte 0, 0, 0, 0, 0
