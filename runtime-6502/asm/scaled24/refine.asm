; What follows makes 24 bits of what a table has: in proportion between two entries, then
; better by what is wrong with it.

; Of the step in sum_hi (its lower byte) and sum1_lo, sum1_hi (its upper one) the part of
; 65536: a and above (high), perhaps two too small.
proportion24:
        ldy part+1
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        sta across
        lda (sum1_lo),y
        sbc (dif1_lo),y
        tax
        lda (sum1_hi),y
        sbc (dif1_hi),y
        sta above
        ldy part
        lda (sum1_hi),y
        sbc (dif1_hi),y
        clc
        adc across
        bcc proportion24_lower
        inc above
        clc
proportion24_lower:
        stx across
        adc across
        bcc proportion24_done
        inc above
proportion24_done:
        rts

; Bits 16 to 31 of the product of arg and prod+3, prod+4, prod+5, both without a sign, in a
; and x (high), but for what is carried from below.
middle24:
        lda prod+3
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        lda prod+4
        sta sum1_lo
        sta sum1_hi
        eor #$ff
        sta dif1_lo
        sta dif1_hi
        lda prod+5
        sta sum2_lo
        sta sum2_hi
        eor #$ff
        sta dif2_lo
        sta dif2_hi
        ldy arg+2
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta across
        lda (sum_hi),y
        sbc (dif_hi),y
        sta above
        lda (sum1_lo),y
        sbc (dif1_lo),y
        clc
        adc above
        sta above
        ldy arg+1
        sec
        lda (sum2_lo),y
        sbc (dif2_lo),y
        clc
        adc above
        sta above
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        sta beside
        lda (sum1_lo),y
        sbc (dif1_lo),y
        sta beneath
        lda (sum1_hi),y
        sbc (dif1_hi),y
        clc
        adc above
        sta above
        jsr middle24_add
        ldy arg
        sec
        lda (sum1_hi),y
        sbc (dif1_hi),y
        sta beside
        lda (sum2_lo),y
        sbc (dif2_lo),y
        sta beneath
        lda (sum2_hi),y
        sbc (dif2_hi),y
        clc
        adc above
        sta above
        jsr middle24_add
        ldx above
        rts
middle24_add:
        lda across
        clc
        adc beside
        bcc middle24_beneath
        inc above
        clc
middle24_beneath:
        adc beneath
        bcc middle24_done
        inc above
middle24_done:
        sta across
        rts

; Adds the number of 16 bits in a and x (high), by the byte y, over 65536, rounded, to
; prod+3, prod+4 and prod+5; at most all bits set.
correct24:
        sty sum_lo
        sty sum_hi
        sta across
        tya
        eor #$ff
        sta dif_lo
        sta dif_hi
        stx sign
        txa
        bpl correct24_plus
        sec
        lda #0
        sbc across
        sta across
        lda #0
        sbc sign
        tax
correct24_plus:
        ldy across
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        sta across
        txa
        tay
        lda (sum_lo),y
        sbc (dif_lo),y
        tax
        lda (sum_hi),y
        sbc (dif_hi),y
        sta above
        txa
        clc
        adc across
        bcc correct24_upper
        inc above
correct24_upper:
        asl                 ; half of the last place
        lda above
        adc #0
        bit sign
        bmi correct24_minus
        clc
        adc prod+3
        sta prod+3
        bcc correct24_done
        inc prod+4
        bne correct24_done
        inc prod+5
        bne correct24_done
        lda #$ff
        sta prod+3
        sta prod+4
        sta prod+5
correct24_done:
        rts
correct24_minus:
        sta across
        sec
        lda prod+3
        sbc across
        sta prod+3
        bcs correct24_done
        lda prod+4
        bne correct24_borrow
        dec prod+5
correct24_borrow:
        dec prod+4
        rts
