        lda log_z
        sta log_x
        lda log_z+1
