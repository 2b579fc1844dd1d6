        asl
        asl
        asl
        asl
        sta log_n
        lda log_x
        lsr
        lsr
        lsr
        lsr
        ora log_n
        tay                 ; which of the 256
        lda log_x
        and #$0f
        ora log_n
        tax                 ; where between two, by which sixteenth of the octaves
