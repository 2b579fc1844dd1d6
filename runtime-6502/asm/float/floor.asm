; acc = the magnitude of fa, cut, float_guard what is below its last place, and float_unlike whether
; more is; the carry: that acc saturates, with its sign
float_whole:
        lda fa+3
        sta float_sign
        lda #0
        sta float_guard
        sta float_unlike
        lda fa+4
        cmp #137
        bcc float_whole_short
        cmp #160
        bcc float_whole_long
        jmp float_whole_most
float_whole_long:
        lda fa+3
        ora #$80
        sta fa+3
        sec
        lda #160
        sbc fa+4
float_whole_bytes:
        cmp #8
        bcc float_whole_bits
        sbc #8
        tay
        lda float_guard
        ora float_unlike
        sta float_unlike
        lda fa
        sta float_guard
        lda fa+1
        sta fa
        lda fa+2
        sta fa+1
        lda fa+3
        sta fa+2
        lda #0
        sta fa+3
        tya
        bpl float_whole_bytes
        bmi float_whole_bytes
float_whole_bits:
        tax
        beq float_whole_placed
float_whole_bit:
        lsr fa+3
        ror fa+2
        ror fa+1
        ror fa
        ror float_guard
        bcc float_whole_lost
        sec
        rol float_unlike
float_whole_lost:
        dex
        bne float_whole_bit
float_whole_placed:
        ldx #3
float_whole_byte:
        lda fa,x
        sta acc,x
        dex
        bpl float_whole_byte
        clc
        rts
float_whole_short:          ; below 256
        ldx #0
        stx acc+1
        stx acc+2
        stx acc+3
        cmp #128
        bcc float_whole_none
        eor #$ff            ; 136 less the exponent
        adc #136
        tax
        lda fa
        ora fa+1
        ora fa+2
        sta float_unlike
        lda fa+2
        sta float_guard
        lda fa+3
        ora #$80
        cpx #0
        beq float_whole_kept
float_whole_fewer:
        lsr
        ror float_guard
        dex
        bne float_whole_fewer
float_whole_kept:
        sta acc
        clc
        rts
float_whole_none:           ; below a half
        sta float_unlike
        stx acc
        rts
; acc = the greatest int, or the least; the carry is set
float_whole_most:
        lda #$7f
        ldx #$ff
        bit float_sign
        bpl float_whole_store
        lda #$80
        ldx #0
float_whole_store:
        sta acc+3
        stx acc+2
        stx acc+1
        stx acc
        sec
        rts

; acc = the greatest int that is not above fa; saturates
float_floor:
        jsr float_whole
        bcs float_floor_done
        bit float_sign
        bpl float_floor_done
        lda float_guard
        ora float_unlike
        beq float_whole_minus
        jsr float_whole_up
        jmp float_whole_minus
float_floor_done:
        rts

; acc = the int nearest to fa, halves away from zero; saturates
float_to_nearest:
        jsr float_whole
        bcs float_floor_done
        bit float_guard
        bpl float_nearest_sign
        jsr float_whole_up
float_nearest_sign:
        bit float_sign
        bmi float_whole_minus
        lda acc+3
        bmi float_whole_most
        rts
float_whole_up:
        inc acc
        bne float_whole_upped
        inc acc+1
        bne float_whole_upped
        inc acc+2
        bne float_whole_upped
        inc acc+3
float_whole_upped:
        rts
float_whole_minus:
        sec
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
        lda #0
        sbc acc+2
        sta acc+2
        lda #0
        sbc acc+3
        sta acc+3
        rts
