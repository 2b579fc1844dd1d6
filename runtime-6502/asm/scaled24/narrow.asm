; acc = acc, y bits to the right, rounded, held to 24 bits.
narrow24_right:
        jsr right32
narrow_to_24:
        lda acc+2           ; does the upper byte only repeat the sign?
        asl
        lda #0
        adc #$ff
        eor #$ff
        cmp acc+3
        bne narrow_to_24_large
narrow_to_24_edge:
        lda acc+2
        cmp #$80            ; the one number that has no negative
        bne narrow_to_24_done
        lda acc
        ora acc+1
        bne narrow_to_24_done
        inc acc
narrow_to_24_done:
        rts
narrow_to_24_large:
        bit acc+3
        bmi narrow_to_24_least
narrow_to_24_most:
        lda #$ff
        sta acc
        sta acc+1
        lda #$7f
        sta acc+2
        rts
narrow_to_24_least:
        lda #1
        sta acc
        lda #0
        sta acc+1
        lda #$80
        sta acc+2
        rts

; The same y bits to the left.
narrow24_left:
        jsr narrow_to_24
left24:
        cpy #0
        beq narrow_to_24_edge
        lda acc+2
        sta sign
left24_bit:
        asl acc
        rol acc+1
        rol acc+2
        lda acc+2
        eor sign
        bmi left24_large
        dey
        bne left24_bit
        jmp narrow_to_24_edge
left24_large:
        bit sign
        bpl narrow_to_24_most
        bmi narrow_to_24_least
