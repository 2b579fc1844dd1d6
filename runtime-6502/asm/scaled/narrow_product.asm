; a and x (high) = a, prod+2 and prod+1, y bits to the right, rounded; saturates.
narrow24:
        ldx prod+1
        stx acc
        ldx prod+2
        stx acc+1
        sta acc+2
        asl
        lda #0
        adc #$ff
        eor #$ff
        sta acc+3
        jmp narrow_right
