        lda #>(sqr_lo)
        sta sum_lo+1
        lda #>(sqr_hi)
        sta sum_hi+1
        lda #>(sqd_lo)
        sta dif_lo+1
        lda #>(sqd_hi)
        sta dif_hi+1
