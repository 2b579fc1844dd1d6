; acc = the whole number nearest to the real in acc, halves away from 0: half of twice its
; magnitude's whole part, and of what that leaves. From 256 on no more is known than that part.
log_round:
        lda acc+2           ; its sign
        pha
        lda acc+1
        bmi log_round_few
        cmp #8*log_octave
        bcs log_round_many
log_round_few:
        clc
        adc #log_octave
        sta acc+1
        jsr log_whole
        lsr acc+1
        ror acc
        lda acc
        adc #0
        sta acc
        bcc log_round_sign
        inc acc+1
log_round_sign:
        pla
        beq log_round_done
        jmp log_floor_negate
log_round_many:
        jsr log_whole
        jmp log_round_sign
log_round_done:
        rts
