set_parts:
        lda #<(log_parts)
        sta parts_at
        rts

; acc = the whole part of 2^(acc/1024), in four bytes; from 512 on it has nine bits.
log_whole:
        lda #0
        sta acc+2
        sta acc+3
        lda acc+1
        bmi log_whole_none
        and #3
        clc
        adc #>(log_parts)
        sta parts_at+1
        ldy acc
        lda acc+1
        lsr
        lsr
        tax                 ; octaves
        lda (parts_at),y    ; with 256 the nine bits
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
        dex
log_whole_more:
        cpx #8
        bne log_whole_twice
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
        bpl log_short_fits
        lda #$7f
        sta acc+1
        lda #$ff
        sta acc
log_short_fits:
        rts
