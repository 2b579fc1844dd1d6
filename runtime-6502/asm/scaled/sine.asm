; The sine or cosine of the angle in a and x (high), radians with 16 - y bits behind the point,
; y to 11: 14 bits behind the point in a and x (high). A quarter of a turn is looked up by eight
; bits, the next eight in proportion.
cosine16:
        jsr quarters
        adc #1              ; no carry: a quarter further on
        jmp sine16_look
sine16:
        jsr quarters
sine16_look:
        lsr
        sta count           ; bit 0: below 0
        ldx prod+2
        ldy prod+1
        bcc sine16_up
        txa                 ; the way back
        eor #$ff
        tax
        tya
        eor #$ff
        tay
sine16_up:
        sec
        lda sines_low+1,x
        sbc sines_low,x
        sta sum_hi
        eor #$ff
        sta dif_hi
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        clc
        adc sines_low,x
        sta prod
        lda sines_high,x
        adc #0
        lsr                 ; entries have 15 bits
        ror prod
        bcc sine16_rounded
        inc prod
        bne sine16_rounded
        adc #0
sine16_rounded:
        tax
        lda count
        lsr
        bcs sine16_minus
        lda prod
        rts
sine16_minus:
        stx prod+1
        lda #0
        sbc prod            ; a carry: nothing is borrowed
        tay
        lda #0
        sbc prod+1
        tax
        tya
        rts

; That angle in quarters of a turn: a, of which two bits count, and 16 bits behind the point in
; prod+2 and prod+1; leaves no carry. It is multiplied by (163 - 13/512) / 256, 2 / pi but
; for 2^-22.
quarters:
        sty count
        tay
        sec
        lda sqr_lo+163,y    ; 163 a0; no product of bytes borrows
        sbc sqd_lo+92,y
        sta prod
        lda sqr_hi+163,y
        sbc sqd_hi+92,y
        sta prod+1
        lda sqr_hi+13,y     ; 13 a0 / 256
        sbc sqd_hi+242,y
        sta acc
        txa
        tay
        lda sqr_lo+13,y     ; 13 a1
        sbc sqd_lo+242,y
        sta acc+1
        lda sqr_hi+13,y
        sbc sqd_hi+242,y
        tax
        clc
        lda acc+1
        adc acc
        bcc quarters_halved
        inx
quarters_halved:
        sta acc             ; 13 a / 512
        txa
        lsr
        sta acc+1
        ror acc
        sec
        lda sqr_lo+163,y    ; 163 a1
        sbc sqd_lo+92,y
        sta prod+2
        lda sqr_hi+163,y
        sbc sqd_hi+92,y
        tax
        clc
        lda prod+2
        adc prod+1
        sta prod+1
        bcc quarters_less
        inx
quarters_less:
        sec
        lda prod
        sbc acc
        sta prod
        lda prod+1
        sbc acc+1
        sta prod+1
        bcs quarters_sign
        dex
quarters_sign:
        tya
        bmi quarters_minus
        stx prod+2
        lda #0
quarters_point:             ; a, prod+2, prod+1 and prod have 24 bits behind the point
        ldy count
        cpy #5
        bcs quarters_byte
        dey
        bmi quarters_done
quarters_left:              ; at most 4 turns
        asl prod
        rol prod+1
        rol prod+2
        rol
        dey
        bpl quarters_left
quarters_done:
        clc
        rts
quarters_minus:             ; it was taken for 65536 more
        clc
        lda prod
        adc #$80
        sta prod
        lda prod+1
        adc #6
        sta prod+1
        txa
        adc #93             ; less 163
        sta prod+2
        lda #$ff
        bne quarters_point
quarters_byte:              ; eight bits to the left, and some of them back
        lda prod+2
        ldx prod+1
        stx prod+2
        ldx prod
        stx prod+1
        cpy #8
        beq quarters_whole
        bcs quarters_more
quarters_right:             ; at most 3 turns
        lsr
        ror prod+2
        ror prod+1
        iny
        cpy #8
        bne quarters_right
quarters_whole:
        clc
        rts
quarters_more:              ; at most 3 turns
        asl prod+1
        rol prod+2
        rol
        dey
        cpy #8
        bne quarters_more
        clc
        rts
