log_arc_small:
        cmp #256-5*log_octave
        bcc log_arc_same    ; the octave before is less by 1, and before it by nothing
        jmp log_curve_less
log_arc_same:
        rts

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
