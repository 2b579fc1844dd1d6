; acc = the int nearest to acc in 16.16, halves away from zero.
fixed_round:
        ldx #0              ; the sign, for the upper half
        lda acc+3
        bpl fixed_round_up
        dex
        clc
        lda acc             ; below zero: add a half less one place
        adc #$ff
        lda acc+1
        adc #$7f
        jmp fixed_round_high
fixed_round_up:
        lda acc+1
        cmp #$80            ; a half or more carries
fixed_round_high:
        lda acc+2
        adc #0
        sta acc
        lda acc+3
        adc #0
        sta acc+1
        txa
        adc #0
        sta acc+2
        sta acc+3
        rts

; acc = the int in acc as 16.16; saturates.
fixed_from_int:
        lda acc+3
        sta sign
        ldx acc+1           ; does it fit 16 bits, sign included?
        bmi fixed_from_minus
        ora acc+2
        beq fixed_from_fits
        jmp saturate
fixed_from_minus:
        and acc+2
        cmp #$ff
        beq fixed_from_fits
        jmp saturate
fixed_from_fits:
        stx acc+3
        lda acc
        sta acc+2
        lda #0
        sta acc
        sta acc+1
        rts
