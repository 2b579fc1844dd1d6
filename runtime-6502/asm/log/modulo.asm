; acc = acc - arg floor(acc / arg), of reals, or 0 where that is no remainder.
log_modulo:
        lda acc
        sta prod
        lda acc+1
        sta prod+1
        lda acc+2
        sta prod+2
        lda arg
        sta prod+3
        lda arg+1
        sta prod+4
        lda arg+2
        sta prod+5
        lda acc+2
        eor arg+2
        sta acc+2
        sec
        lda acc
        sbc arg
        sta acc
        lda acc+1
        sbc arg+1
        sta acc+1
        jsr log_keep
        jsr log_floor
        jsr log_hold
        jsr log_from_int
        lda acc+2
        eor prod+5
        sta acc+2
        clc
        lda acc
        adc prod+3
        sta acc
        lda acc+1
        adc prod+4
        sta acc+1
        jsr log_keep
        lda acc
        sta arg
        lda prod
        sta acc
        lda acc+1
        sta arg+1
        lda prod+1
        sta acc+1
        lda acc+2
        sta arg+2
        lda prod+2
        sta acc+2
        jsr log_subtract
        lda acc+2           ; of the divisor's sign,
        cmp prod+5
        bne log_modulo_none
        lda acc             ; and below it?
        cmp prod+3
        lda acc+1
        sbc prod+4
        bvc log_modulo_less
        eor #$80
log_modulo_less:
        bmi log_modulo_done
log_modulo_none:
        lda prod+5
        sta acc+2
        lda #0
        sta acc
        lda #$80
        sta acc+1
log_modulo_done:
        rts

; acc = the int in acc, kept from -32767 to 32767.
log_hold:
        lda acc+3
        bmi log_hold_low
        ora acc+2
        bne log_hold_most
        lda acc+1
        bpl log_hold_done
log_hold_most:
        lda #$7f
        sta acc+1
        lda #$ff
        sta acc
        lda #0
        beq log_hold_above
log_hold_done:
        rts
log_hold_low:
        and acc+2
        cmp #$ff
        bne log_hold_least
        lda acc+1
        bpl log_hold_least
        lda acc             ; -32768?
        bne log_hold_done
        lda acc+1
        cmp #$80
        bne log_hold_done
log_hold_least:
        lda #$80
        sta acc+1
        lda #1
        sta acc
        lda #$ff
log_hold_above:
        sta acc+2
        sta acc+3
        rts
