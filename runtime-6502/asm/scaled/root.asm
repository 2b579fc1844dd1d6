; a and x (high) = the root of a and x times 2 to the y; y is 14 less that, and odd where
; root16_odd is called. What is up to four times less than 65536 is looked up.
root16_odd:
        cpx #$80
        bcs root16_zero
        sta acc
        txa
        asl acc
        rol
        jmp root16_begin
root16:
        cpx #$80
        bcs root16_zero
        sta acc
        txa
root16_begin:               ; y: halvings of the result that are left
        cmp #$40
        bcs root16_look
        tax
        bne root16_scale
        lda acc             ; eight bits at once
        beq root16_zero
        ldx #0
        stx acc
        iny
        iny
        iny
        iny
        cmp #$40
        bcs root16_look
root16_scale:               ; at most 3 turns
        asl acc
        rol
        asl acc
        rol
        iny
        cmp #$40
        bcc root16_scale
root16_look:
        sty count
        tax
        lda roots_step-64,x ; in proportion: the step times the low byte
        sta sum_hi
        eor #$ff
        sta dif_hi
        ldy acc
        sec
        lda (sum_hi),y
        sbc (dif_hi),y
        clc
        adc roots_low-64,x
        sta prod
        lda roots_high-64,x
        adc #0
        ldy count
        beq root16_done
root16_half:
        lsr
        ror prod
        dey
        bne root16_half
        bcc root16_done
        inc prod
        bne root16_done
        adc #0
root16_done:
        tax
        lda prod
        rts
root16_zero:
        lda #0
        tax
        rts
