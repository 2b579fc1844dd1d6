; fa = the tangent of fa: sine over cosine
float_tangent:
        ldx #4
float_tangent_keep:
        lda fa,x
        sta float_tangent_x,x
        dex
        bpl float_tangent_keep
        jsr float_cosine
        ldx #4
float_tangent_place:
        lda float_tangent_x,x
        tay
        lda fa,x
        sta float_tangent_x,x
        sty fa,x
        dex
        bpl float_tangent_place
        jsr float_sine
        ldx #4
float_tangent_by:
        lda float_tangent_x,x
        sta fb,x
        dex
        bpl float_tangent_by
        jmp float_divide
float_tangent_x:
        .byte 0, 0, 0, 0, 0
