; fa = the root of fa, of what is below 0 it is 0. What is left of twice the square's rest is in
; prod, 33 bits with the carry; the root so far in fa; 24 bits of it are found by squares, the
; others by a division.
float_root:
        lda fa+3
        bpl float_root_positive
        jmp float_zero
float_root_positive:
        lda fa+4
        bne float_root_some
        rts
float_root_some:
        lsr                 ; half the exponent, upwards
        bcs float_root_odd
        adc #64
        sta float_exp
        lda fa              ; 2 m - 1/2
        asl
        sta prod
        lda fa+1
        rol
        sta prod+1
        lda fa+2
        rol
        sta prod+2
        lda fa+3
        ora #$80
        rol
        eor #$80
        bpl float_root_begin
        clc
        bcc float_root_begin
float_root_odd:
        adc #64
        sta float_exp
        lda fa
        sta prod
        lda fa+1
        sta prod+1
        lda fa+2
        sta prod+2
        lda fa+3
        clc
float_root_begin:
        sta prod+3
        lda #0
        sta float_exp+1
        sta float_sign
        sta fa
        sta fa+1
        sta fa+2
        sta float_t
        lda #$80
        sta fa+3
        lda #$40
        sta float_n
        lda #$a0
        sta float_t+1
float_root_3:
        bcs float_root_3_take
        lda prod+3
        cmp float_t+1
        bcc float_root_3_next
        bne float_root_3_take
        lda prod+2
        cmp float_t
        bcc float_root_3_next
float_root_3_take:
        sec
        lda prod+2
        sbc float_t
        sta prod+2
        lda prod+3
        sbc float_t+1
        sta prod+3
        lda float_n
        ora fa+3
        sta fa+3
float_root_3_next:
        lsr float_n
        lda float_n
        lsr
        ora fa+3
        sta float_t+1
        lda #0
        ror
        sta float_t
        asl prod
        rol prod+1
        rol prod+2
        rol prod+3
        lda float_n
        bne float_root_3
        lda #$80
        sta float_n
        lda #$40
        sta float_t+1
        lda #0
        sta float_t
float_root_2:
        bcs float_root_2_take
        lda prod+3
        cmp fa+3
        bcc float_root_2_next
        bne float_root_2_take
        lda prod+2
        cmp float_t+1
        bcc float_root_2_next
        bne float_root_2_take
        lda prod+1
        cmp float_t
        bcc float_root_2_next
float_root_2_take:
        sec
        lda prod+1
        sbc float_t
        sta prod+1
        lda prod+2
        sbc float_t+1
        sta prod+2
        lda prod+3
        sbc fa+3
        sta prod+3
        lda float_n
        ora fa+2
        sta fa+2
float_root_2_next:
        lsr float_n
        lda float_n
        lsr
        ora fa+2
        sta float_t+1
        lda #0
        ror
        sta float_t
        asl prod
        rol prod+1
        rol prod+2
        rol prod+3
        lda float_n
        bne float_root_2
        lda #$80
        sta float_n
        lda #$40
        sta float_t+1
        lda #0
        sta float_t
float_root_1:
        bcs float_root_1_take
        lda prod+3
        cmp fa+3
        bcc float_root_1_next
        bne float_root_1_take
        lda prod+2
        cmp fa+2
        bcc float_root_1_next
        bne float_root_1_take
        lda prod+1
        cmp float_t+1
        bcc float_root_1_next
        bne float_root_1_take
        lda prod
        cmp float_t
        bcc float_root_1_next
float_root_1_take:
        sec
        lda prod
        sbc float_t
        sta prod
        lda prod+1
        sbc float_t+1
        sta prod+1
        lda prod+2
        sbc fa+2
        sta prod+2
        lda prod+3
        sbc fa+3
        sta prod+3
        lda float_n
        ora fa+1
        sta fa+1
float_root_1_next:
        lsr float_n
        lda float_n
        lsr
        ora fa+1
        sta float_t+1
        lda #0
        ror
        sta float_t
        asl prod
        rol prod+1
        rol prod+2
        rol prod+3
        lda float_n
        bne float_root_1
        lda prod+3
        ldy #8
float_root_bit:
        bcs float_root_take
        cmp fa+3
        bcc float_root_shift
        bne float_root_take
        sta prod+3
        lda prod+2
        cmp fa+2
        bne float_root_told
        lda prod+1
        cmp fa+1
float_root_told:
        lda prod+3
        bcc float_root_shift
float_root_take:
        sec
        sta prod+3
        lda prod+1
        sbc fa+1
        sta prod+1
        lda prod+2
        sbc fa+2
        sta prod+2
        lda prod+3
        sbc fa+3
        sec
float_root_shift:
        rol bits
        asl prod
        rol prod+1
        rol prod+2
        rol
        dey
        bne float_root_bit
        bcs float_root_up
        sta prod+3
        lda prod+1
        cmp fa+1
        lda prod+2
        sbc fa+2
        lda prod+3
        sbc fa+3
float_root_up:
        ror float_guard
        lda bits
        sta fa
        jmp float_round
