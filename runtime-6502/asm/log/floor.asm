; acc = the greatest whole number that is not above the real in acc.
log_floor:
        lda acc+2
        bne log_floor_minus
        jmp log_whole
log_floor_minus:
        lda acc
        sta log_x
        lda acc+1
        sta log_x+1
        jsr log_whole
        lda #0              ; above 512, no more is known
        cmp log_x
        lda #9*log_octave
        sbc log_x+1
        bvs log_floor_few
        bmi log_floor_negate
log_floor_few:
        jsr log_is_whole
        beq log_floor_negate
        ldx #3              ; 1 less
log_floor_not:
        lda acc,x
        eor #$ff
        sta acc,x
        dex
        bpl log_floor_not
        rts
log_floor_negate:
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
        lda #0
        sbc acc+2
        sta acc+2
        lda #0
        sbc acc+3
        sta acc+3
        rts
