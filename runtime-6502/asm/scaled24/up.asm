; prod+3, prod+4 and a (high) = the upper 24 bits of prod+2, prod+3, prod+4 and a, y bits to
; the left, rounded; saturates. y from 1 to 4.
up24:
        sta prod+5
        sta sign
up24_bit:
        asl prod+2
        rol prod+3
        rol prod+4
        rol prod+5
        lda prod+5
        eor sign
        bmi up24_large
        dey
        bne up24_bit
        lda prod+5
        bit prod+2
        bpl up24_edge
        inc prod+3
        bne up24_edge
        inc prod+4
        bne up24_edge
        clc
        adc #1
        bvs up24_most
up24_edge:
        cmp #$80            ; the one number that has no negative
        beq up24_least_of_all
        rts
up24_least_of_all:
        lda prod+3
        ora prod+4
        bne up24_fits
        inc prod+3
up24_fits:
        lda #$80
        rts
up24_large:
        bit sign
        bmi up24_least
up24_most:
        lda #$ff
        sta prod+3
        sta prod+4
        lda #$7f
        rts
up24_least:
        lda #1
        sta prod+3
        lda #0
        sta prod+4
        lda #$80
        rts
