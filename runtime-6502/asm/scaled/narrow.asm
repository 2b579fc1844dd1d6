; a and x (high) = acc, y bits to the right, rounded; saturates.
narrow_right:
        jsr right32
narrow:
        ldx acc+1
        lda acc+3           ; do the upper bytes only repeat the sign?
        bmi narrow_minus
        ora acc+2
        bne narrow_most
        txa
        bmi narrow_most
        lda acc
        rts
narrow_minus:
        and acc+2
        cmp #$ff
        bne narrow_least
        txa
        bpl narrow_least
        lda acc
        bne narrow_done
        cpx #$80            ; the one number that has no negative
        beq narrow_least
narrow_done:
        rts
narrow_most:
        lda #$ff
        ldx #$7f
        rts
narrow_least:
        lda #1
        ldx #$80
        rts

; The same y bits to the left.
narrow_left:
        jsr narrow
left16:
        cpy #0
        beq left16_done
        sta acc
        stx sign
left16_bit:
        asl acc
        txa
        rol
        tax
        eor sign
        bmi left16_large
        dey
        bne left16_bit
        lda acc
        bne left16_done
        cpx #$80
        beq narrow_least
left16_done:
        rts
left16_large:
        bit sign
        bpl narrow_most
        bmi narrow_least
