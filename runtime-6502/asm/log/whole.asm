set_parts:
        lda #<(log_parts)
        sta parts_at
        rts

; acc = the whole part of 2^(acc/1024), in four bytes; from 512 on it has nine bits.
log_whole:
        lda #0
        sta acc+2
        sta acc+3
        lda acc+1
        bmi log_whole_none
        and #log_octave-1
        clc
        adc #>(log_parts)
        sta parts_at+1
        ldy acc
        lda acc+1
