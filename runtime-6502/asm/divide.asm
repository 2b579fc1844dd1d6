; acc = (prod, acc) / arg, prod = the remainder; unsigned, 64 / 32 bits, where the
; remainder so far, the 32 bits of prod, is below arg, and arg at most 2^31.
; A byte of quotient that is 0 at the front is skipped whole.
divide:
        ldx #3              ; which byte of acc: dividend out, quotient in
divide_skip:
        lda prod+3
        bne divide_byte
        lda prod+2          ; is (prod, next byte) below arg?
        cmp arg+3
        bcc divide_zero
        bne divide_byte
        lda prod+1
        cmp arg+2
        bcc divide_zero
        bne divide_byte
        lda prod
        cmp arg+1
        bcc divide_zero
        bne divide_byte
        lda acc,x
        cmp arg
        bcs divide_byte
divide_zero:
        lda prod+2
        sta prod+3
        lda prod+1
        sta prod+2
        lda prod
        sta prod+1
        lda acc,x
        sta prod
        lda #0
        sta acc,x
        dex
        bpl divide_skip
        rts

divide_byte:
        lda arg+3
        beq divide_short
divide_long:
        stx low
        lda acc,x
        sta bits
        lda #8
        sta count
divide_bit:
        rol bits            ; the last quotient bit in, the next dividend bit out
        rol prod
        rol prod+1
        rol prod+2
        rol prod+3
        sec
        lda prod
        sbc arg
        tay
        lda prod+1
        sbc arg+1
        tax
        lda prod+2
        sbc arg+2
        sta carried
        lda prod+3
        sbc arg+3
        bcc divide_less
        sta prod+3
        lda carried
        sta prod+2
        stx prod+1
        sty prod
divide_less:
        dec count
        bne divide_bit
        lda bits
        rol
        ldx low
        sta acc,x
        dex
        bpl divide_long
        rts

divide_short:               ; arg and remainder fit 24 bits
        stx low
        lda acc,x
        sta bits
        lda #8
        sta count
divide_short_bit:
        rol bits
        rol prod
        rol prod+1
        rol prod+2
        bcs divide_short_more
        sec
        lda prod
        sbc arg
        tay
        lda prod+1
        sbc arg+1
        tax
        lda prod+2
        sbc arg+2
        bcc divide_short_less
divide_short_store:
        sta prod+2
        stx prod+1
        sty prod
divide_short_less:
        dec count
        bne divide_short_bit
        lda bits
        rol
        ldx low
        sta acc,x
        dex
        bpl divide_short
        rts
divide_short_more:          ; a 25th bit: not below arg, and the borrow takes it
        lda prod
        sbc arg
        tay
        lda prod+1
        sbc arg+1
        tax
        lda prod+2
        sbc arg+2
        sec
        bcs divide_short_store

; acc = x / 0 for the x in acc: 0, or saturated by its sign.
divide_by_zero:
        lda acc+3
        sta sign
        ora acc+2
        ora acc+1
        ora acc
        beq divide_zero_zero
        jmp saturate
divide_zero_zero:
        rts
