; Pages of the pointers into the quarter squares.
set_squares24:
        lda #>(sqr_lo)
        sta sum1_lo+1
        sta sum2_lo+1
        lda #>(sqr_hi)
        sta sum1_hi+1
        sta sum2_hi+1
        lda #>(sqd_lo)
        sta dif1_lo+1
        sta dif2_lo+1
        lda #>(sqd_hi)
        sta dif1_hi+1
        sta dif2_hi+1
        rts
