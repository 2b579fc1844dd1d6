; fa = the natural logarithm of fa; of what is not above 0 the most negative
float_logarithm:
        lda fa+4
        beq float_log_none
        bit fa+3
        bpl float_log_some
float_log_none:
        lda #$80
        sta float_sign
        jmp float_most
float_log_some:
        ldx #128            ; from the root of 1/2 to that of 2
        lda fa
        cmp #$33
        lda fa+1
        sbc #$f3
        lda fa+2
        sbc #$04
        lda fa+3
        sbc #$35
        bcs float_log_upper
        ldx #129
float_log_upper:
        stx float_n
        sec
        lda fa+4
        sbc float_n
        sta float_log_whole
        lda float_n
        sta fa+4
        ldx #4
float_log_keep:
        lda fa,x
        sta float_log_x,x
        dex
        bpl float_log_keep
        jsr float_one
        jsr float_subtract  ; z = (m - 1) / (m + 1)
        ldx #4
float_log_place:
        lda float_log_x,x
        tay
        lda fa,x
        sta float_log_x,x
        sty fa,x
        dex
        bpl float_log_place
        jsr float_one
        jsr float_add
        jsr float_to_second
        ldx #4
float_log_by:
        lda float_log_x,x
        sta fa,x
        dex
        bpl float_log_by
        jsr float_divide
        lda fa+3
        sta float_sign
        lda #<(float_logarithm_terms)
        sta float_at
        lda #>(float_logarithm_terms)
        sta float_at+1
        jsr float_odd
        lda fa+4
        beq float_log_double
        inc fa+4            ; 2 z P(z z)
float_log_double:
        ldx #4
float_log_low:
        lda fa,x
        sta float_log_x,x
        dex
        bpl float_log_low
        ldx #0
        lda float_log_whole
        sta acc
        bpl float_log_plus
        dex
float_log_plus:
        stx acc+1
        stx acc+2
        stx acc+3
        jsr float_from_int
        lda #$f8            ; times log 2
        sta fb
        lda #$17
        sta fb+1
        lda #$72
        sta fb+2
        lda #$31
        sta fb+3
        lda #128
        sta fb+4
        jsr float_multiply
        ldx #4
float_log_sum:
        lda float_log_x,x
        sta fb,x
        dex
        bpl float_log_sum
        jmp float_add
float_log_whole:
        .byte 0
float_log_x:
        .byte 0, 0, 0, 0, 0
