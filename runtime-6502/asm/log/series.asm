; acc = the logarithm of x (1 - z k1 (1 - z k2 ...)) for z = x x, from that of x; x and y:
; where the logarithms of the k stand in log_terms, and behind which they end.
log_series:
        lda acc+1
        cmp #>(log_of_short_series)        ; below that is x
        bpl log_series_long
        rts
log_series_long:
        stx count
        sty bits
        lda acc
        sta log_x
        asl
        sta log_z
        lda acc+1
        sta log_x+1
        rol
        sta log_z+1
        lda #0
        sta acc
        sta acc+1
log_series_next:
        ldx count
        clc
        lda acc
        adc log_terms,x
        sta arg
        lda acc+1
        adc log_terms+1,x
        sta arg+1
        clc
        lda arg
        adc log_z
        sta arg
        lda arg+1
        adc log_z+1
        sta arg+1
        lda #0
        sta acc
        sta acc+1
        jsr log_minus
        inc count
        inc count
        lda count
        cmp bits
        bne log_series_next
        clc
        lda acc
        adc log_x
        sta acc
        lda acc+1
        adc log_x+1
        sta acc+1
        rts
