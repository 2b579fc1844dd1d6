; acc = the tangent of acc in radians, 16.16; saturates.
tangent:
        lda acc+3
        sta tangent_sign
        jsr quadrants
        sta tangent_quadrant
        lsr                 ; tan(a + pi/2) = -1 / tan(a)
        ror
        eor tangent_sign
        sta tangent_sign
        ldx #3
tangent_keep:
        lda acc,x
        sta tangent_into,x
        dex
        bpl tangent_keep
        lda tangent_quadrant
        jsr quadrant_sine
        ldx #3
tangent_sine:
        lda prod+4,x
        sta tangent_up,x
        lda tangent_into,x
        sta acc,x
        dex
        bpl tangent_sine
        lda tangent_quadrant
        eor #1              ; the cosine, but for its sign
        jsr quadrant_sine
        ldx #3
tangent_cosine:
        lda prod+4,x
        sta arg,x
        lda tangent_up,x
        sta acc,x
        dex
        bpl tangent_cosine
        lsr arg+3           ; a half of each, so that neither looks negative
        ror arg+2
        ror arg+1
        ror arg
        lsr acc+3
        ror acc+2
        ror acc+1
        ror acc
        jsr fixed_divide
        bit tangent_sign
        bmi tangent_below
        rts
tangent_below:
        jmp negate
tangent_sign:
        .byte 0
tangent_quadrant:
        .byte 0
tangent_into:
        .byte 0, 0, 0, 0
tangent_up:
        .byte 0, 0, 0, 0
