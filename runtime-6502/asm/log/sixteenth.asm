; y a = that less six octaves, over 16; the carry is set, and a 0, where nothing is left of so
; much. x = 0.
log_sixteenth:
        cmp #100
        bcs log_sixteenth_none
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
log_sixteenth_none:
        lda #0
        tax
        rts
