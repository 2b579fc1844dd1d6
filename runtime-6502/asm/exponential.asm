; acc = e^acc in 16.16; saturates.
exponential:
        lda acc+3
        sta exponential_below
        bmi exponential_minus
        bne exponential_large
        lda acc+2
        cmp #16
        bcs exponential_large
        bcc exponential_fits
exponential_minus:
        cmp #$ff
        bne exponential_small
        lda acc+2
        cmp #$f0
        bcc exponential_small
        jsr negate
exponential_fits:
        asl acc             ; times log2(e), with 48 bits behind the point
        rol acc+1
        rol acc+2
        lda #$29
        sta arg
        lda #$3b
        sta arg+1
        lda #$aa
        sta arg+2
        lda #$b8
        sta arg+3
        jsr multiply
        bit exponential_below
        bpl exponential_up
        ldx #4
exponential_flip:
        lda prod+2,x
        eor #$ff
        sta prod+2,x
        dex
        bpl exponential_flip
exponential_up:
        jsr power_of_two
        bcs exponential_large
        rts
exponential_small:
        jmp power_of_two_small
exponential_large:
        lda #0
        sta sign
        jmp saturate
exponential_below:
        .byte 0
