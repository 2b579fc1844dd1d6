        tax                 ; octaves
        lda (parts_at),y    ; with 256 the nine bits
        cpx #5
        bcs log_whole_large
        sta log_n
        lda #1              ; few bits come soonest from above
        cpx #0
        beq log_whole_few
log_whole_bit:
        asl log_n
        rol
        dex
        bne log_whole_bit
log_whole_few:
        sta acc
        stx acc+1
        rts
log_whole_large:
        cpx #31
        bcs log_whole_most
        cpx #8
        bcs log_whole_left
        sta acc
        lda #1
        sta acc+1
log_whole_right:
        lsr acc+1
        ror acc
        inx
        cpx #8
        bne log_whole_right
        rts
log_whole_left:
        sta acc
        lda #1
        sta acc+1
        bne log_whole_more
log_whole_twice:
        asl acc
        rol acc+1
        rol acc+2
        rol acc+3
        dex
log_whole_more:
        cpx #8
        bne log_whole_twice
        rts
log_whole_most:
        lda #$ff
        sta acc
        sta acc+1
        sta acc+2
        lda #$7f
        sta acc+3
        rts
log_whole_none:
        lda #0
        sta acc
        sta acc+1
        rts

; The same, at most 32767.
log_short:
        jsr log_whole
        lda acc+1
        and #$80            ; beyond 15 bits?
        ora acc+2
        ora acc+3
        beq log_short_fits
        lda #$7f
        sta acc+1
        lda #$ff
        sta acc
log_short_fits:
        rts
