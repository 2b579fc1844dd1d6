; acc = the sine of the real in acc.
log_sine:
        lda #0
        ldx acc+2
        stx carried
        jsr log_quarter_sine
        lda acc+2
        eor carried
        sta acc+2
        rts

; acc = its cosine.
log_cosine:
        lda #1

; acc = the sine of the magnitude in acc and so many quarter turns.
log_quarter_sine:
        sta log_quarter
        lda acc
        sta arg
        lda acc+1
        sta arg+1
        sec                 ; the whole quarter turns in it
        lda acc
        sbc #<(log_of_quarter)
        sta acc
        lda acc+1
        sbc #>(log_of_quarter)
        bvc log_sine_turns
        lda #$80            ; none
log_sine_turns:
        sta acc+1
        jsr log_short
        clc
        lda acc
        tay
        adc log_quarter
        sta log_quarter
        lda #0
        sta log_side        ; the rest's sign
        lda acc+1
        bne log_sine_whole
        tya
        beq log_sine_first
        lda log_logs_low,y  ; less the whole ones
        clc
        adc #<(log_of_quarter)
        sta acc
        lda log_logs_high,y
        adc #>(log_of_quarter)
        sta acc+1
        jsr log_sine_sides
        jmp log_sine_rest
log_sine_whole:
        jsr log_least
        jmp log_sine_rest
log_sine_first:
        lda arg
        sta acc
        lda arg+1
        sta acc+1
log_sine_rest:
        lda log_quarter
        lsr
        bcc log_sine_angle
        lda #<(log_of_quarter)     ; less the rest
        sta arg
        lda #>(log_of_quarter)
        sta arg+1
        lda log_side
        beq log_sine_less
        lda #0
        sta log_side
        jsr log_plus
        jmp log_sine_angle
log_sine_less:
        jsr log_sine_sides
log_sine_angle:
        lda log_quarter
        lsr
        lsr
        lda #0
        rol
        eor log_side
        sta acc+2
        ldx #0
        ldy #6
        jmp log_series

; acc = what is left of the magnitude in arg less the one in acc; log_side is its sign.
log_sine_sides:
        sec
        lda arg
        sbc acc
        lda arg+1
        sbc acc+1
        bvc log_sine_told
        eor #$80
log_sine_told:
        asl
        lda #0
        rol
        sta log_side
        jmp log_minus
