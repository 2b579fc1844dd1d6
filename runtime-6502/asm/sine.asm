; acc = the sine of acc in radians, 16.16.
sine:
        lda acc+3           ; sin(-a) = -sin(a): two quadrants on
        asl
        lda #0
        rol
        asl
        sta sine_turn
        jsr quadrants
        clc
        adc sine_turn
        jmp sine_round

; acc = the cosine of acc in radians: the sine a quadrant on.
cosine:
        jsr quadrants
        clc
        adc #1
sine_round:
        jsr quadrant_sine
        asl prod+5          ; 63 bits behind the point become 16
        rol prod+6
        rol prod+7
        lda #0
        sta acc+3
        rol
        sta acc+2
        asl prod+5          ; the bit below the last place
        lda prod+6
        adc #0
        sta acc
        lda prod+7
        adc #0
        sta acc+1
        lda acc+2
        adc #0
        sta acc+2
        lsr sine_turn
        bcs sine_below
        rts
sine_below:
        jmp negate

; A = the quadrant of the magnitude of acc, acc = how far it is into it, 0.32.
quadrants:
        lda acc+3
        bpl quadrants_up
        jsr negate
quadrants_up:
        lda #$6e            ; 2 / pi
        sta arg
        lda #$83
        sta arg+1
        lda #$f9
        sta arg+2
        lda #$a2
        sta arg+3
        jsr multiply
        ldx #3
quadrants_copy:
        lda prod+2,x
        sta acc,x
        dex
        bpl quadrants_copy
        lda prod+6
        rts

; prod = the sine's magnitude in quadrant A, acc into it; sine_turn: whether it is negative.
quadrant_sine:
        lsr
        and #1
        sta sine_turn
        bcc quadrant_sine_up
        ldx #3              ; it falls in odd quadrants
quadrant_sine_flip:
        lda acc,x
        eor #$ff
        sta acc,x
        dex
        bpl quadrant_sine_flip
quadrant_sine_up:
        lda #<(sine_terms)
        sta terms
        lda #>(sine_terms)
        sta terms+1
        jmp odd_series
sine_turn:
        .byte 0
