; y a = that less six octaves, over 16, and x = 0. The carry is clear, before and behind.
log_sixteenth:
        sbc #47
        sta log_n
        tya
        lsr log_n
        ror
        lsr log_n
        ror
        lsr log_n
        ror
        lsr log_n
        ror
        tay
        ldx #0
        lda log_n
        clc
        rts
