; acc = the cosine of acc in radians, 16.16: the sine a quadrant on.
cosine:
        ldx #1
        lda acc+3
        bpl sine_from
        bmi sine_minus
; acc = the sine of acc in radians, 16.16: a quarter of a turn is looked up by eight bits, the
; next sixteen in proportion.
sine:
        ldx #0
        lda acc+3
        bpl sine_from
        ldx #2              ; sin(-a) = -sin(a): two quadrants on
sine_minus:
        stx count
        jsr negate
        ldx count
sine_from:
        stx count
        lda #0
        sta prod+1
        sta prod+2
        sta prod+3
        sta prod+4
        tax                 ; which byte of the angle
; In quarters of a turn, 24 bits behind the point in prod to prod+2: byte by byte from the lowest,
; what there is a byte to the right and the byte times 2 / pi in 32 bits, $a2f9836e, on top.
sine_byte:
        ldy acc,x
        bne sine_product
        lda prod+1
        sta prod
        lda prod+2
        sta prod+1
        lda prod+3
        sta prod+2
        lda prod+4
        sta prod+3
        sty prod+4
        inx
        cpx #4
        bne sine_byte
        beq sine_quadrant
sine_product:
        sec
        lda sqr_lo+110,y
        sbc sqd_lo+145,y
        sta low
        lda sqr_hi+110,y
        sbc sqd_hi+145,y
        sta carried
        sec
        lda sqr_lo+131,y
        sbc sqd_lo+124,y
        sta arg
        lda sqr_hi+131,y
        sbc sqd_hi+124,y
        sta arg+1
        sec
        lda sqr_lo+249,y
        sbc sqd_lo+6,y
        sta arg+2
        lda sqr_hi+249,y
        sbc sqd_hi+6,y
        sta arg+3
        sec
        lda sqr_lo+162,y
        sbc sqd_lo+93,y
        sta bits
        lda sqr_hi+162,y
        sbc sqd_hi+93,y
        tay                 ; the upper byte of the last; of the others in a row
        clc
        lda carried
        adc arg
        sta arg
        lda arg+1
        adc arg+2
        sta arg+1
        lda arg+3
        adc bits
        bcc sine_sum
        iny
        clc
sine_sum:
        sta arg+2
        lda low
        adc prod+1
        sta prod
        lda arg
        adc prod+2
        sta prod+1
        lda arg+1
        adc prod+3
        sta prod+2
        lda arg+2
        adc prod+4
        sta prod+3
        tya
        adc #0
        sta prod+4
        inx
        cpx #4
        beq sine_quadrant
        jmp sine_byte
sine_quadrant:
        lda prod+3
        clc
        adc count
        lsr
        sta count           ; bit 0: below 0
        ldx prod+2
        bcc sine_entry
        txa                 ; the way back
        eor #$ff
        tax
        lda prod+1
        eor #$ff
        sta prod+1
        lda prod
        eor #$ff
        sta prod
sine_entry:
        sec                 ; to the next entry
        lda wide_sines_low+1,x
        sbc wide_sines_low,x
        sta low
        lda wide_sines_middle+1,x
        sbc wide_sines_middle,x
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy prod+1
        sec
        lda (sum_lo),y
        sbc (dif_lo),y
        sta acc
        lda (sum_hi),y
        sbc (dif_hi),y
        sta acc+1
        ldy prod
        lda (sum_lo),y
        cmp (dif_lo),y
        lda (sum_hi),y
        sbc (dif_hi),y
        clc
        adc acc
        sta acc
        bcc sine_lower
        inc acc+1
sine_lower:
        lda low
        sta sum_lo
        sta sum_hi
        eor #$ff
        sta dif_lo
        sta dif_hi
        ldy prod+1
        lda (sum_lo),y
        cmp (dif_lo),y
        lda (sum_hi),y
        sbc (dif_hi),y
        clc
        adc acc
        sta acc
        bcc sine_on
        inc acc+1
        clc
sine_on:
        lda wide_sines_low,x
        adc acc
        sta acc
        lda wide_sines_middle,x
        adc acc+1
        sta acc+1
        lda wide_sines_high,x
        adc #0
        asl acc             ; 23 bits behind the point become 16
        rol acc+1
        rol
        tay
        lda #0
        sta acc+3
        rol
        sta acc+2
        asl acc             ; the bit below the last place
        lda acc+1
        adc #0
        sta acc
        tya
        adc #0
        sta acc+1
        bcc sine_rounded
        inc acc+2
sine_rounded:
        lsr count
        bcs sine_below
        rts
sine_below:
        jmp negate
