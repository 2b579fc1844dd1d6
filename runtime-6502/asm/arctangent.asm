; prod = the angle of (y, x) = (acc, arg), both unsigned, at most 2^31 and not
; both 0: from 0 to pi/2 in radians, 32 bits behind the point, prod+4 before it.
arctangent:
        lda acc
        cmp arg
        lda acc+1
        sbc arg+1
        lda acc+2
        sbc arg+2
        lda acc+3
        sbc arg+3
        ror arctangent_steep
        bpl arctangent_flat
        ldx #3              ; y >= x: the angle from the other axis
arctangent_swap:
        lda arg,x
        sta prod,x
        lda acc,x
        sta arg,x
        dex
        bpl arctangent_swap
        bmi arctangent_ratio
arctangent_flat:
        ldx #3
arctangent_copy:
        lda acc,x
        sta prod,x
        dex
        bpl arctangent_copy
arctangent_ratio:
        ldx #3
arctangent_like:
        lda prod,x
        cmp arg,x
        bne arctangent_less
        dex
        bpl arctangent_like
        lda #$ff            ; as near to 1 as 0.32 comes
        sta acc
        sta acc+1
        sta acc+2
        sta acc+3
        bne arctangent_sum
arctangent_less:
        lda #0
        sta acc
        sta acc+1
        sta acc+2
        sta acc+3
        jsr divide
arctangent_sum:
        lda #<(arctangent_terms)
        sta terms
        lda #>(arctangent_terms)
        sta terms+1
        jsr odd_series
        asl prod+3
        ldx #0
        ldy #4
arctangent_result:          ; twice the upper half, to the place of the lower
        lda prod+4,x
        rol
        sta prod,x
        inx
        dey
        bne arctangent_result
        sty prod+4
        bit arctangent_steep
        bpl arctangent_done
        sec                 ; pi/2 - prod
        lda #$44
        sbc prod
        sta prod
        lda #$b5
        sbc prod+1
        sta prod+1
        lda #$1f
        sbc prod+2
        sta prod+2
        lda #$92
        sbc prod+3
        sta prod+3
        lda #1
        sbc prod+4
        sta prod+4
arctangent_done:
        rts

; acc = prod to the nearest place of 16.16, signed.
arctangent_round:
        asl prod+1
        lda prod+2
        adc #0
        sta acc
        lda prod+3
        adc #0
        sta acc+1
        lda prod+4
        adc #0
        sta acc+2
        asl
        lda #0
        sta acc+3
        bcc arctangent_rounded
        dec acc+3
arctangent_rounded:
        rts
arctangent_steep:
        .byte 0

; acc = the angle of (y, x) = (acc, arg) in radians, 16.16; of (0, 0) it is 0.
arctangent2:
        lda acc
        ora acc+1
        ora acc+2
        ora acc+3
        ora arg
        ora arg+1
        ora arg+2
        ora arg+3
        bne arctangent2_somewhere
        rts
arctangent2_somewhere:
        lda acc+3
        sta arctangent2_below
        lda arg+3
        sta arctangent2_left
        jsr magnitudes
        jsr arctangent
        bit arctangent2_left
        bpl arctangent2_right
        sec                 ; pi - prod
        lda #$89
        sbc prod
        sta prod
        lda #$6a
        sbc prod+1
        sta prod+1
        lda #$3f
        sbc prod+2
        sta prod+2
        lda #$24
        sbc prod+3
        sta prod+3
        lda #3
        sbc prod+4
        sta prod+4
arctangent2_right:
        jsr arctangent_round
        bit arctangent2_below
        bpl arctangent2_done
        jmp negate
arctangent2_done:
        rts
arctangent2_below:
        .byte 0
arctangent2_left:
        .byte 0
