; a and x (high) = the upper 16 bits of a, prod+2 and prod+1 two, three or four bits to the
; left, rounded; saturates. All bits that are lost must be the sign.
up12:
        tax
        clc
        adc #$08
        cmp #$10
        bcs up_large
        txa
        asl prod+1
        rol prod+2
        rol
        jmp up13_bits
up13:
        tax
        clc
        adc #$10
        cmp #$20
        bcs up_large
        txa
up13_bits:
        asl prod+1
        rol prod+2
        rol
        jmp up14_bits
up14:
        tax
        clc
        adc #$20
        cmp #$40
        bcs up_large
        txa
up14_bits:
        asl prod+1
        rol prod+2
        rol
        asl prod+1
        rol prod+2
        rol
        ldx prod+1
        bpl up_cut
        inc prod+2
        bne up_cut
        clc
        adc #1
        bvs up_most
up_cut:
        tax
        cpx #$80
        beq up_edge
        lda prod+2
        rts
up_edge:
        lda prod+2          ; the one number that has no negative
        bne up_done
        lda #1
up_done:
        rts
up_large:
        txa
        bmi up_least
up_most:
        lda #$ff
        ldx #$7f
        rts
up_least:
        lda #1
        ldx #$80
        rts
