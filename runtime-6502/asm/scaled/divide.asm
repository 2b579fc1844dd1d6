; a and x (high) = acc / arg with y bits more, to the nearest; saturates. By 0 the
; greatest with the sign of acc. Magnitudes are shifted to bit 14 first, so that at most
; 16 bits of quotient are left.
divide16_zero:
        lda #0
        tax
        rts
divide16_by_zero:
        jmp divide16_large
divide16:
        sty count
        lda acc+1
        eor arg+1
        sta sign
        lda arg+1
        bpl divide16_divisor
        sec
        lda #0
        sbc arg
        sta arg
        lda #0
        sbc arg+1
        sta arg+1
divide16_divisor:
        lda acc+1
        bpl divide16_dividend
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
divide16_dividend:
        lda acc
        ora acc+1
        beq divide16_zero
        lda arg
        ora arg+1
        beq divide16_by_zero
        lda arg+1
divide16_up:
        cmp #$40
        bcs divide16_high
        asl arg
        rol
        inc count
        bne divide16_up
divide16_high:
        sta arg+1
        lda acc+1
divide16_down:
        cmp #$40
        bcs divide16_ready
        ldy count
        beq divide16_ready
        asl acc
        rol
        dec count
        bpl divide16_down
divide16_ready:
        sta acc+1
        ldy #0
        sty prod
        sty prod+1
        ldy count
        cpy #16
        bcs divide16_large
        lda acc             ; the whole part: 0 or 1
        cmp arg
        lda acc+1
        sbc arg+1
        bcc divide16_start
        sta acc+1
        lda acc
        sbc arg
        sta acc
        inc prod
divide16_start:
        cpy #0
        beq divide16_round
divide16_bit:
        asl acc
        rol acc+1
        lda acc
        sec
        sbc arg
        tax
        lda acc+1
        sbc arg+1
        bcc divide16_less
        sta acc+1
        stx acc
divide16_less:
        rol prod
        rol prod+1
        dey
        bne divide16_bit
divide16_round:
        asl acc
        rol acc+1
        lda acc
        cmp arg
        lda acc+1
        sbc arg+1
        bcc divide16_sign
        inc prod
        bne divide16_sign
        inc prod+1
divide16_sign:
        lda prod+1
        bmi divide16_large
        bit sign
        bmi divide16_minus
        tax
        lda prod
        rts
divide16_minus:
        sec
        lda #0
        sbc prod
        tay
        lda #0
        sbc prod+1
        tax
        tya
        rts
divide16_large:
        bit sign
        bmi divide16_least
        lda #$ff
        ldx #$7f
        rts
divide16_least:
        lda #1
        ldx #$80
        rts
