; a and x (high) = a power of two over arg: the reciprocal y bits to the right, less those
; that arg was shifted; saturates, by 0 too.
one_over:
        sty count
        lda arg+1
        sta sign
        bpl one_over_plus
        sec
        lda #0
        sbc arg
        sta arg
        lda #0
        sbc arg+1
        sta arg+1
one_over_plus:
        ora arg
        beq one_over_large
        jsr reciprocal
        stx prod
        lda count
        sec
        sbc prod
        beq one_over_large
        bmi one_over_large
        cmp #17
        bcs one_over_small
        tax
        lda prod+5
one_over_right:             ; at most 16 turns
        lsr
        ror prod+4
        dex
        bne one_over_right
        bcc one_over_round
        inc prod+4
        bne one_over_round
        adc #0
one_over_round:
        cmp #$80
        bcs one_over_large
        tax
        lda prod+4
        bit sign
        bmi one_over_minus
        rts
one_over_minus:
        sta prod+4
        stx prod+5
        sec
        lda #0
        sbc prod+4
        tay
        lda #0
        sbc prod+5
        tax
        tya
        rts
one_over_small:
        lda #0
        tax
        rts
one_over_large:
        bit sign
        bmi one_over_least
        lda #$ff
        ldx #$7f
        rts
one_over_least:
        lda #1
        ldx #$80
        rts
