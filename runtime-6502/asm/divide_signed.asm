; acc = the magnitude of acc / that of arg, prod = the remainder, arg = its magnitude; sign
; tells that of the quotient. A quotient of few bits, which most are, takes a step for each:
; the divisor is doubled up to the dividend, and taken off on its way back.
divide_signed:
        jsr magnitudes
        lda acc+3
        ora arg+3
        bne divide_signed_long
        lda acc+1           ; eight bits of quotient or more?
        cmp arg
        lda acc+2
        sbc arg+1
        lda #0
        sbc arg+2
        bcs divide_signed_long
        ldy #0
        lda acc
        sta prod
        sty acc
        lda acc+1
        sta prod+1
        sty acc+1
        lda acc+2
        sta prod+2
        sty acc+2
        sty prod+3
divide_signed_up:
        lda prod
        cmp arg
        lda prod+1
        sbc arg+1
        lda prod+2
        sbc arg+2
        bcc divide_signed_down
        iny
        asl arg
        rol arg+1
        rol arg+2
        bcc divide_signed_up
        ror arg+2           ; 25 bits are too many, and one less was not
        ror arg+1
        ror arg
        dey
        bpl divide_signed_try
divide_signed_down:
        dey
        bmi divide_signed_done
        lsr arg+2
        ror arg+1
        ror arg
divide_signed_try:
        sec
        lda prod
        sbc arg
        tax
        lda prod+1
        sbc arg+1
        sta low
        lda prod+2
        sbc arg+2
        bcc divide_signed_bit
        sta prod+2
        lda low
        sta prod+1
        stx prod
divide_signed_bit:
        rol acc
        bcc divide_signed_down
divide_signed_done:
        rts
divide_signed_long:
        lda #0
        sta prod
        sta prod+1
        sta prod+2
        sta prod+3
        jmp divide
