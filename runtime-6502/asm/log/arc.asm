; acc = the logarithm of the angle of (x, y), both above 0: y's in acc, x's in arg.
log_angle:
        sec
        lda acc
        sbc arg
        tay
        lda acc+1
        sbc arg+1
        bvs log_angle_far
        bpl log_angle_steep
log_angle_flat:
        sty acc
        sta acc+1
        jmp log_arc
log_angle_far:              ; the ratio is the least
        ldy #0
        asl
        lda #$80
        bcc log_angle_flat
        bcs log_angle_upright
log_angle_steep:
        sec
        lda arg
        sbc acc
        tay
        lda arg+1
        sbc acc+1
log_angle_upright:
        sty acc
        sta acc+1
        jsr log_arc
        lda #<(log_of_quarter)     ; less that
        ldx #>(log_of_quarter)
; acc = a x less acc.
log_less_acc:
        ldy acc
        sty arg
        ldy acc+1
        sty arg+1
        sta acc
        stx acc+1
        jmp log_minus

; acc = the angle whose tangent it is, at most 1: from the root of 2 less 1 on an eighth of a
; turn less that of (1 - x) / (1 + x).
log_arc:
        lda acc
        cmp #<(log_of_steep)
        lda acc+1
        sbc #>(log_of_steep)
        bpl log_arc_long
        ldx #6
        ldy #10
        jmp log_series
log_arc_long:
        lda acc
        sta prod
        sta arg
        lda acc+1
        sta prod+1
        sta arg+1
        lda #0
        sta acc
        sta acc+1
        jsr log_plus
        lda acc
        sta prod+2
        lda acc+1
        sta prod+3
        lda prod
        sta acc
        lda prod+1
        sta acc+1
        lda #0
        tax
        jsr log_less_acc
        sec
        lda acc
        sbc prod+2
        sta acc
        lda acc+1
        sbc prod+3
        bvc log_arc_fits
        lda #0
        sta acc
        lda #$80
log_arc_fits:
        sta acc+1
        ldx #6
        ldy #10
        jsr log_series
        lda #<(log_of_eighth)
        ldx #>(log_of_eighth)
        jmp log_less_acc

; acc = the angle of (x, y): y in acc, x in arg.
log_arctangent2:
        lda arg+2
        pha
        jsr log_angle
        pla
        bne log_left
        rts

; acc = half a turn less acc.
log_left:
        lda #<(log_of_half_turn)
        ldx #>(log_of_half_turn)
        jmp log_less_acc

; acc = the angle whose sine it is, of what is kept within -1 and 1.
log_arcsine:
        lda acc+1
        bpl log_arcsine_end
        jsr log_beside
        jmp log_angle
log_arcsine_end:
        lda #<(log_of_quarter)
        sta acc
        lda #>(log_of_quarter)
        sta acc+1
        rts

; acc = the angle whose cosine it is.
log_arccosine:
        lda acc+2
        pha
        lda acc+1
        bpl log_arccosine_end
        jsr log_beside
        ldx acc
        ldy arg
        stx arg
        sty acc
        ldx acc+1
        ldy arg+1
        stx arg+1
        sty acc+1
        jsr log_angle
        jmp log_arccosine_side
log_arccosine_end:
        jsr log_least
log_arccosine_side:
        lda #0
        sta acc+2
        pla
        bne log_left
        rts

; arg = the root of 1 less the square of acc, of two logarithms.
log_beside:
        lda acc
        sta prod
        sta arg
        lda acc+1
        sta prod+1
        sta arg+1
        asl arg
        rol arg+1
        bmi log_beside_squared      ; below 0 as it was
        lda #0
        sta arg
        lda #$80
        sta arg+1
log_beside_squared:
        lda #0
        sta acc
        sta acc+1
        jsr log_minus
        lda acc+1
        cmp #$80
        ror
        sta arg+1
        lda acc
        ror
        sta arg
        lda prod
        sta acc
        lda prod+1
        sta acc+1
        rts
