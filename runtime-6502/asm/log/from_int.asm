; acc = the real nearest to the int in acc.
log_from_int:
        lda acc+3
        asl
        lda #0
        rol
        sta log_side
        beq log_from_magnitude
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
log_from_magnitude:
        ldx log_side
        lda acc+2
        ora acc+3
        bne log_from_long
        stx acc+2
        lda acc+1
        bpl log_of_short
        ldx #0              ; of its half, an octave above
        stx acc+2
log_from_long:
        ldy #0
log_from_half:
        iny
        lsr acc+3
        ror acc+2
        ror acc+1
        ror acc
        lda acc+2
        ora acc+3
        bne log_from_half
        lda acc+1
        bmi log_from_half
        ldx log_side
        stx acc+2
        sty log_z
        jsr log_of_short
        ldy log_z
log_from_double:
        clc
        lda acc+1
        adc #log_octave
        bvs log_from_most
        sta acc+1
        dey
        bne log_from_double
        rts
log_from_most:
        jmp log_most

; acc = the logarithm of the int in acc, from 0 to 32767, two bytes.
log_of_short:
        lda acc+1
        cmp #2
        bcs log_of_long
        jsr log_of_acc
        sta acc
        stx acc+1
        rts
log_of_long:
        lda acc             ; the sum of 64 times what is above six bits, and the rest
        and #63
        sta log_n
        lda #0
        asl acc
        rol acc+1
        rol
        asl acc
        rol acc+1
        rol
        ldx acc+1
        stx acc
        sta acc+1
        jsr log_of_acc
        sta acc
        clc
        txa
        adc #6*log_octave
        sta acc+1
        ldy log_n
        beq log_of_even
        lda log_logs_low,y
        sta arg
        lda log_logs_high,y
        sta arg+1
        jmp log_plus
log_of_even:
        rts
