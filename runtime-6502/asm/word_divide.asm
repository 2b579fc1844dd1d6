; acc = acc / arg, the remainder in a: 16 bits from 0 on by a byte above 0. A quotient of one
; byte, as most are, takes half as long.
word_divide:
        lda #0
        ldx #1              ; which byte of acc: dividend out, quotient in
        ldy acc+1
        cpy arg
        bcs word_divide_byte
        tya
        ldy #0
        sty acc+1
        dex
word_divide_byte:
        ldy #8
word_divide_bit:
        rol acc,x           ; the last quotient bit in, the next dividend bit out
        rol
        bcs word_divide_more
        cmp arg
        bcc word_divide_less
word_divide_more:
        sbc arg
        sec
word_divide_less:
        dey
        bne word_divide_bit
        rol acc,x
        dex
        bpl word_divide_byte
        rts

; acc = the remainder of the same.
word_modulo:
        jsr word_divide
        sta acc
        lda #0
        sta acc+1
        rts
