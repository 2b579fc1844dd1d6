; acc = acc * acc in 16.16, to the nearest; saturates. From 256 on it is too large at once, so
; there are three bytes: each two's product is added twice, then the bytes' own squares.
fixed_square:
        lda acc+3
        sta sign            ; for what negates: the result is not below 0
        bpl fixed_square_plus
        jsr negate
fixed_square_plus:
        lda #0
        sta sign
        lda acc+3
        beq fixed_square_bytes
        jmp saturate
fixed_square_bytes:
        lda acc
        sta sum_lo          ; f(a + y) and f(a - y), as in a product
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy acc
        lda (sum_hi),y      ; f(2a) = a a
        sta prod            ; below it nothing is rounded
        ldy acc+1
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta prod+1
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+2
        ldy acc+2           ; nothing is borrowed from a whole product
        lda (sum_lo),y
        sbc (dif_lo),y
        tax
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+3
        txa
        clc
        adc prod+2
        sta prod+2
        bcc fixed_square_middle
        inc prod+3
fixed_square_middle:
        lda acc+1
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        sec                 ; y = acc+2
        lda (sum_lo),y
        sbc (dif_lo),y
        tax
        lda (sum_hi),y
        sbc (dif_hi),y
        sta prod+4
        ldy acc+1
        lda (sum_lo),y
        sta low
        lda (sum_hi),y
        sta carried
        txa
        clc
        adc prod+3
        sta prod+3
        bcc fixed_square_twice
        inc prod+4
fixed_square_twice:
        asl prod+1
        rol prod+2
        rol prod+3
        rol prod+4
        lda #0
        rol
        sta prod+5
        ldy acc+2
        sty sum_lo
        sty sum_hi
        clc
        lda prod+1
        adc prod
        tax                 ; its upper bit is the one below the last place
        lda prod+2
        adc low
        sta prod+2
        lda prod+3
        adc carried
        sta prod+3
        lda (sum_lo),y
        adc prod+4
        sta prod+4
        lda (sum_hi),y
        adc prod+5
        bmi fixed_square_large
        cpx #$80
        tay
        lda prod+2
        adc #0
        sta acc
        lda prod+3
        adc #0
        sta acc+1
        lda prod+4
        adc #0
        sta acc+2
        tya
        adc #0
        sta acc+3
        bmi fixed_square_large
        rts
fixed_square_large:
        jmp saturate
