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
