; a and x (high) = 2^22 over the root of a and x, y bits to the right (y is signed), rounded; of
; twice the number where reciprocal_root_odd is called. Saturates, by what is not above 0 too.
reciprocal_root_odd:
        cpx #$80
        bcs reciprocal_root_most
        sta acc
        txa
        asl acc
        rol
        jmp reciprocal_root_begin
reciprocal_root:
        cpx #$80
        bcs reciprocal_root_most
        sta acc
        txa
reciprocal_root_begin:      ; y: halvings of the result that are left
        cmp #$40
        bcs reciprocal_root_look
        tax
        bne reciprocal_root_up
        lda acc             ; eight bits at once
        beq reciprocal_root_most
        ldx #0
        stx acc
        dey
        dey
        dey
        dey
        cmp #$40
        bcs reciprocal_root_look
reciprocal_root_up:         ; at most 3 turns
        asl acc
        rol
        asl acc
        rol
        dey
        cmp #$40
        bcc reciprocal_root_up
reciprocal_root_look:
        sty count
        tax
        lda reciprocal_roots_step-64,x
        sta sum_hi          ; in proportion: the step times the low byte
        eor #$ff
        sta dif_hi
        ldy acc
        clc
        lda (dif_hi),y      ; what is taken away, negative and less 1: a carry is no borrow
        sbc (sum_hi),y
        sec
        adc reciprocal_roots_low-64,x
        sta prod
        lda reciprocal_roots_high-64,x
        sbc #0
        ldy count
        beq reciprocal_root_whole
        bmi reciprocal_root_most
        cpy #16
        bcs reciprocal_root_none
reciprocal_root_half:       ; at most 15 turns
        lsr
        ror prod
        dey
        bne reciprocal_root_half
        bcc reciprocal_root_done
        inc prod
        bne reciprocal_root_done
        adc #0
reciprocal_root_done:
        tax
        lda prod
        rts
reciprocal_root_whole:
        tax
        bmi reciprocal_root_most
        lda prod
        rts
reciprocal_root_none:
        lda #0
        tax
        rts
reciprocal_root_most:
        lda #$ff
        ldx #$7f
        rts
