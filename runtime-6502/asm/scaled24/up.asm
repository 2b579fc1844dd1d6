; prod+3, prod+4 and a (high) = the upper 24 bits of prod+2, prod+3, prod+4 and a, y bits to
; the left, rounded; saturates. y from 1 to 4.
up24:
        sta sign
        clc
        adc up24_half-1,y   ; are the bits that are shifted out all signs?
        cmp up24_room-1,y
        bcs up24_large
        lda sign
up24_bit:
        asl prod+2
        rol prod+3
        rol prod+4
        rol
        dey
        bne up24_bit
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
up24_half:
        .byte 64,32,16,8
up24_room:
        .byte 128,64,32,16
