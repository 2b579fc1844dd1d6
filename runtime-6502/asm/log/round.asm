; acc = the whole number nearest to the real in acc.
log_round:
        lda #0
        sta arg
        sta arg+2
        lda #256-log_octave  ; a half
        sta arg+1
        jsr log_add
        jmp log_floor
