; e to the a and x (high), which has 16 - y bits behind the point, y to 6: as many bits behind
; the point in a and x (high) as 79 less bits, 15 at most; saturates. The exponent of two is
; split: its fraction is looked up by eight bits, the next eight in proportion.
exponential16:
        sty count
        sta arg
        tay
        sec
        lda sqr_lo+113,y    ; 113 a0; no product of bytes borrows
        sbc sqd_lo+142,y
        sta prod
        lda sqr_hi+113,y
        sbc sqd_hi+142,y
        sta prod+1
        lda sqr_hi+169,y    ; 169 a0 / 256
        sbc sqd_hi+86,y
        sta acc
        txa
        tay
        lda sqr_lo+169,y    ; 169 a1
        sbc sqd_lo+86,y
        sta acc+1
        lda sqr_hi+169,y
        sbc sqd_hi+86,y
        tax
        clc
        lda acc+1
        adc acc
        bcc exponential16_halved
        inx
exponential16_halved:
        sta acc             ; 169 a / 512
        txa
        lsr
        sta acc+1
        ror acc
        sec
        lda sqr_lo+113,y    ; 113 a1
        sbc sqd_lo+142,y
        sta prod+2
        lda sqr_hi+113,y
        sbc sqd_hi+142,y
        tax
        clc                 ; all of it: 369 + 169/512 times a is 256 log2(e) a but for 2^-13
        lda prod
        adc acc
        sta prod
        lda prod+1
        adc acc+1
        bcc exponential16_lower
        inx
        clc
exponential16_lower:
        adc prod+2
        bcc exponential16_middle
        inx
        clc
exponential16_middle:
        adc arg
        sta prod+1
        stx prod+2
        tya
        adc prod+2
        sta prod+2
        lda #0
        adc #0
        cpy #$80
        bcc exponential16_point
        sta prod+3          ; a below 0 was taken for 65536 more; a carry: nothing is borrowed
        lda prod
        sbc #$80
        sta prod
        lda prod+1
        sbc #$54
        sta prod+1
        lda prod+2
        sbc #$71
        sta prod+2
        lda prod+3
        sbc #1
exponential16_point:
        ldy count
        beq exponential16_split
exponential16_left:
        asl prod
        rol prod+1
        rol prod+2
        rol
        dey
        bne exponential16_left
exponential16_split:        ; the whole part, and 16 bits behind the point
        sta acc
        sec
        lda bits
        sbc acc
        sec
        sbc #65             ; halvings of what is looked up, less 1
        bcc exponential16_large
        cmp #17
        bcs exponential16_small
        sta count
        ldx prod+2
        ldy prod+1
        lda powers_low+1,x
        sec
        sbc powers_low,x
        sta sum_hi
        eor #$ff
        sta dif_hi
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        clc
        adc powers_low,x
        sta prod
        lda powers_high,x
        adc #0
        ldy count
        cpy #8
        bcc exponential16_right
        sta prod            ; eight bits at once
        tya
        sbc #8
        tay
        lda #0
exponential16_right:        ; at most 9 turns
        lsr
        ror prod
        dey
        bpl exponential16_right
        bcc exponential16_rounded
        inc prod
        bne exponential16_rounded
        adc #0
exponential16_rounded:
        tax
        bmi exponential16_large
        lda prod
        rts
exponential16_small:
        lda #0
        tax
        rts
exponential16_large:
        lda #$ff
        ldx #$7f
        rts
