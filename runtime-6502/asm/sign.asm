; acc and arg become their magnitudes; sign tells that of their product.
; The most negative number becomes 2^31, as an unsigned number.
magnitudes:
        lda acc+3
        eor arg+3
        sta sign
        lda arg+3
        bpl magnitudes_acc
        sec
        lda #0
        sbc arg
        sta arg
        lda #0
        sbc arg+1
        sta arg+1
        lda #0
        sbc arg+2
        sta arg+2
        lda #0
        sbc arg+3
        sta arg+3
magnitudes_acc:
        lda acc+3
        bmi negate
        rts

; acc = acc, or -acc where the sign says so.
signed:
        bit sign
        bmi negate
        rts

; acc = -acc, wrapping.
negate:
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
        lda #0
        sbc acc+2
        sta acc+2
        lda #0
        sbc acc+3
        sta acc+3
        rts

; acc = the largest or the most negative number, by the sign.
saturate:
        lda #$7f
        ldx #$ff
        bit sign
        bpl saturate_store
        lda #$80
        ldx #0
saturate_store:
        sta acc+3
        stx acc+2
        stx acc+1
        stx acc
        rts
