; fa = fa - fb floor(fa / fb), with the sign of fb; 0 where that is 0
float_modulo:
        lda fb+4
        bne float_modulo_by
        jmp float_zero
float_modulo_by:
        lda fa+4
        bne float_modulo_some
        rts
float_modulo_some:
        lda fb+3
        tax
        eor fa+3
        sta float_unlike
        stx float_sign
        txa
        ora #$80
        sta fb+3
        lda fa+3
        ora #$80
        sta fa+3
        lda fa+4
        sec
        sbc fb+4
        bcc float_modulo_rest   ; less than the divisor
        tax
        lda #0
        sta float_guard
        sta float_exp+1
        lda fb+4
        sta float_exp
        clc
        bcc float_modulo_turn
float_modulo_next:
        dex
        asl fa
        rol fa+1
        rol fa+2
        rol fa+3
float_modulo_turn:
        bcs float_modulo_take
        lda fa+3
        cmp fb+3
        bcc float_modulo_less
        bne float_modulo_take
        lda fa+2
        cmp fb+2
        bcc float_modulo_less
        bne float_modulo_take
        lda fa+1
        cmp fb+1
        bcc float_modulo_less
        bne float_modulo_take
        lda fa
        cmp fb
        bcc float_modulo_less
float_modulo_take:
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
float_modulo_less:
        cpx #0
        bne float_modulo_next
        lda fa
        ora fa+1
        ora fa+2
        ora fa+3
        bne float_modulo_left
        jmp float_zero
float_modulo_left:
        jsr float_normal
        jmp float_modulo_signs
float_modulo_rest:
        lda float_sign
        ora #$7f
        and fa+3
        sta fa+3
float_modulo_signs:         ; with unlike signs it is counted from the other end
        bit float_unlike
        bmi float_modulo_other
        rts
float_modulo_other:
        jsr float_negate
        lda float_sign
        ora #$7f
        and fb+3
        sta fb+3
        jmp float_add
