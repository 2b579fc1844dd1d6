; a = acc, y bits to the right, rounded, in 8 bits; saturates.
narrow8_right:
        jsr narrow_right
        jmp hold8
; The same y bits to the left.
narrow8_left:
        jsr narrow_left
; a = a and x (high) in 8 bits; saturates.
hold8:
        cpx #$80
        bcs hold8_minus
        cpx #0
        bne hold8_most
        cmp #$80
        bcs hold8_most
        rts
hold8_minus:
        inx
        bne hold8_least
        cmp #$81            ; the one number that has no negative is none of ours
        bcc hold8_least
        rts
hold8_most:
        lda #$7f
        rts
hold8_least:
        lda #$81
        rts

; acc = a and prod (low).
take_product8:
        tax
        lda prod
        ldy #0
        jmp widen
