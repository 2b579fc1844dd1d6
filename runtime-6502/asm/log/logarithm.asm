; acc = the natural logarithm of the real in acc, of 0 and below the most negative value.
log_natural:
        lda acc+2
        bne log_natural_none
        jsr log_is_least
        bcs log_natural_none
        lda acc+1
        ora acc
        beq log_natural_one
        lda acc+1
        jsr log_size
        jsr log_of_short
        sec
        lda acc
        sbc #<(log_of_natural)
        sta acc
        lda acc+1
        sbc #>(log_of_natural)
        sta acc+1
        lda log_side
        sta acc+2
        rts
log_natural_one:
        jmp log_least
log_natural_none:
        lda #1
        sta acc+2
        jmp log_most

; acc = its magnitude, log_side its sign: of two bytes.
log_size:
        asl
        lda #0
        rol
        sta log_side
        beq log_size_done
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
log_size_done:
        rts

; The carry: whether the logarithm in acc is that of 0.
log_is_least:
        lda acc
        bne log_is_more
        lda acc+1
        eor #$80
        bne log_is_more
        sec
        rts
log_is_more:
        clc
        rts
