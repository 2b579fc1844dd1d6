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

; acc = the angle whose tangent it is, at most 1: a little less than that is, by a table of what
; it is less by in 256 parts of the last four octaves, and of what that grows by in each.
log_arc:
        sec                 ; log_z = acc less 1, which is below 0
        lda acc
        sbc #1
        sta log_z
        lda acc+1
        sbc #0
        sta log_z+1
        cmp #256-4*log_octave
        bcc log_arc_small
