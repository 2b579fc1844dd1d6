; fa = fa - fb
float_subtract:
        lda fb+4
        beq float_add_done
        lda fb+3
        eor #$80
        sta fb+3
; fa = fa + fb
float_add:
        lda fb+4
        beq float_add_done
        lda fa+4
        bne float_add_both
        jmp float_to_first
float_add_done:
        rts
float_add_both:
        sta float_exp
        lda #0
        sta float_guard
        sta float_exp+1
        lda fb+3
        tax
        eor fa+3
        sta float_unlike
        txa
        ora #$80
        sta fb+3
        lda fa+3
        sta float_sign
        ora #$80
        sta fa+3
        lda float_exp
        sec
        sbc fb+4
        bne float_add_apart
        jmp float_add_aligned
float_add_apart:
        bcc float_add_less
        jsr float_shift_fb
        bit float_unlike
        bmi float_add_rest
        jmp float_add_sum
float_add_rest:             ; fa - fb
        sec
        lda #0
        sbc float_guard
        sta float_guard
        lda fa
        sbc fb
        sta fa
        lda fa+1
        sbc fb+1
        sta fa+1
        lda fa+2
        sbc fb+2
        sta fa+2
        lda fa+3
        sbc fb+3
        sta fa+3
        jmp float_normal
float_add_less:             ; the second is greater
        eor #$ff
        adc #1
        ldx fb+4
        stx float_exp
        jsr float_shift_fa
        bit float_unlike
        bmi float_add_reverse
        jmp float_add_sum
float_add_reverse:          ; fb - fa
        lda float_sign
        eor #$80
        sta float_sign
        sec
        lda #0
        sbc float_guard
        sta float_guard
        lda fb
        sbc fa
        sta fa
        lda fb+1
        sbc fa+1
        sta fa+1
        lda fb+2
        sbc fa+2
        sta fa+2
        lda fb+3
        sbc fa+3
        sta fa+3
        jmp float_normal
float_add_aligned:
        bit float_unlike
        bpl float_add_sum
        sec
        lda fa
        sbc fb
        sta fa
        lda fa+1
        sbc fb+1
        sta fa+1
        lda fa+2
        sbc fb+2
        sta fa+2
        lda fa+3
        sbc fb+3
        sta fa+3
        bcs float_add_positive
        lda float_sign
        eor #$80
        sta float_sign
        sec
        lda #0
        sbc fa
        sta fa
        lda #0
        sbc fa+1
        sta fa+1
        lda #0
        sbc fa+2
        sta fa+2
        lda #0
        sbc fa+3
        sta fa+3
float_add_positive:
        jmp float_normal
float_add_sum:
        clc
        lda fa
        adc fb
        sta fa
        lda fa+1
        adc fb+1
        sta fa+1
        lda fa+2
        adc fb+2
        sta fa+2
        lda fa+3
        adc fb+3
        sta fa+3
        bcc float_add_fits
        ror fa+3
        ror fa+2
        ror fa+1
        ror fa
        ror float_guard
        inc float_exp
        bne float_add_fits
        inc float_exp+1
float_add_fits:
        jmp float_round
