; a and x (high) = the root of the int in acc with so many fraction bits; y is 255 less those.
; Pairs of bits that are 0 go, and of what is left the upper 16 bits are looked up.
int_root:
        lda acc+3
        bmi int_root_zero
        bne int_root_four
        lda acc+2
        bne int_root_three
        lda acc+1
        bne int_root_two
        lda acc
        beq int_root_zero
        ldx #0              ; nothing below
        stx acc
        iny
        iny
        iny
        iny
int_root_two:
        ldx #0
        stx acc+1
        tax
        tya
        clc
        adc #8
        tay
        txa
        jmp int_root_scale
int_root_three:
        ldx acc+1
        lda acc
        sta acc+1
        stx acc
        lda acc+2
        iny
        iny
        iny
        iny
        jmp int_root_scale
int_root_four:
        ldx acc+2
        stx acc
int_root_scale:             ; a, acc and acc+1: what is left, y: halvings of the result
        cmp #$40
        bcs int_root_look
        asl acc+1
        rol acc
        rol
        asl acc+1
        rol acc
        rol
        iny
        jmp int_root_scale
int_root_look:
        cpy #$80
        bcs int_root_most
        jmp root16_look
int_root_most:
        lda #$ff
        ldx #$7f
        rts
int_root_zero:
        lda #0
        tax
        rts
