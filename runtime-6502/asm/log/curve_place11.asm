        lsr                 ; in units of two
        tax
        lda log_z
        ror
        sta log_x
        txa
