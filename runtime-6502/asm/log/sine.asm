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
        sec                 ; log_z = acc less a quarter turn and 1, below 0
        lda acc
        sbc #<(log_of_quarter+1)
        sta log_z
        lda acc+1
        sbc #>(log_of_quarter+1)
        bvs log_sine_same
        sta log_z+1
        bmi log_sine_below
        lda #$ff
        sta log_z
        sta log_z+1
log_sine_below:
        cmp #254
        bcs log_sine_last
        cmp #256-4*log_octave
        bcc log_sine_small
