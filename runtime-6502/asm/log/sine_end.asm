log_sine_small:
        cmp #256-5*log_octave
        bcc log_sine_same   ; the octave before is less by 1, and before it by nothing
        jmp log_curve_less
log_sine_same:
        rts

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
