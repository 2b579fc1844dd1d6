; acc = the product of the numbers of 24 bits in acc and arg, y bits to the right, rounded,
; held to 24 bits.
exact24_right:
        sty count
        jsr exact24
        ldy count
        cpy #9
        bcc exact24_bits
exact24_byte:
        ldx #0              ; a whole byte
exact24_move:
        lda prod+1,x
        sta prod,x
        inx
        cpx #5
        bne exact24_move
        jsr exact24_sign
        tya
        sec
        sbc #8
        tay
        cpy #9
        bcs exact24_byte
exact24_bits:
        cpy #0
        beq exact24_narrow
exact24_bit:
        lda prod+5
        cmp #$80
        ldx #5
exact24_ror:
        ror prod,x
        dex
        bpl exact24_ror
        dey
        bne exact24_bit
        bcc exact24_narrow
        ldx #256-6
exact24_carry:
        inc prod+6,x
        bne exact24_narrow
        inx
        bne exact24_carry
; acc = prod, of 48 bits, held to 24.
exact24_narrow:
        ldx #2
exact24_copy:
        lda prod,x
        sta acc,x
        dex
        bpl exact24_copy
        lda prod+5
        sta acc+3
        cmp prod+4
        bne exact24_large
        cmp prod+3
        bne exact24_large
        jmp narrow_to_24
exact24_large:
        jmp narrow_to_24_large

; The same product y bits to the left.
exact24_left:
        sty count
        jsr exact24
        jsr exact24_narrow
        ldy count
        jmp left24

; prod = acc * arg, of 24 bits, as 48.
exact24:
        ldx #0
        lda acc+2
        bpl exact24_first
        dex
exact24_first:
        stx acc+3
        ldx #0
        lda arg+2
        bpl exact24_second
        dex
exact24_second:
        stx arg+3
        jsr magnitudes
        jsr multiply
        bit sign
        bpl exact24_done
        ldx #256-6
        sec
exact24_minus:
        lda #0
        sbc prod+6,x
        sta prod+6,x
        inx
        bne exact24_minus
exact24_done:
        rts

; The upper byte that the sign makes.
exact24_sign:
        lda prod+4
        asl
        lda #0
        adc #$ff
        eor #$ff
        sta prod+5
        rts
