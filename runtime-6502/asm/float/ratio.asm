; fa = the int in acc over the one in arg
float_ratio:
        jsr float_from_int
        jsr float_keep
        ldx #3
float_ratio_by:
        lda arg,x
        sta acc,x
        dex
        bpl float_ratio_by
        jsr float_from_int
        jsr float_to_second
        ldx #4
float_ratio_of:
        lda float_x,x
        sta fa,x
        dex
        bpl float_ratio_of
        jmp float_divide
