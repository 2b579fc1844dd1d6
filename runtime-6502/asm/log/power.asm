; acc = the real in acc to the power in arg: 1 where that is 0, of 0 the largest value or 0,
; and 0 where it would be a negative's fraction.
log_power:
        ldx #2              ; the exponent first
log_power_swap:
        ldy arg,x
        lda acc,x
        sta prod,x
        sty acc,x
        sty prod+3,x
        dex
        bpl log_power_swap
        jsr log_is_least
        bcc log_power_some
        lda #0
        sta acc
        sta acc+1
        sta acc+2
        rts
log_power_some:
        lda prod            ; of 0?
        sta acc
        lda prod+1
        sta acc+1
        jsr log_is_least
        bcc log_power_exponent
        lda #0
        sta acc+2
        lda prod+5
        bne log_power_most
        jmp log_least
log_power_most:
        jmp log_most
log_power_exponent:
        lda prod+3          ; is the exponent whole?
        sta acc
        sta log_x
        lda prod+4
        sta acc+1
        sta log_x+1
        jsr log_whole
        lda acc
        sta log_c
        lda acc+1
        sta log_c+1
        cmp #2
        bcc log_power_few
        bne log_power_many
        lda acc
        bne log_power_many
log_power_few:
        jsr log_is_whole
        bne log_power_many
        lda #1
        bne log_power_kind
log_power_many:
        lda #0
log_power_kind:
        sta prod+6
        tay
        lda #0
        sta prod+7          ; the result's sign
        lda prod+2
        beq log_power_sized
        tya
        beq log_power_fraction
        lda log_c
        and #1
        sta prod+7
        bpl log_power_sized
log_power_fraction:
        lda #0              ; above 9 octaves all are whole
        cmp log_x
        lda #9*log_octave
        sbc log_x+1
        bvs log_power_none
        bmi log_power_sized
log_power_none:
        lda #0
        sta acc+2
        jmp log_least
log_power_sized:
        lda prod
        sta acc
        lda prod+1
        sta acc+1
        jsr log_size
        lda acc
        ora acc+1
        beq log_power_scaled
        lda prod+6
        beq log_power_any
        jsr log_times
        jmp log_power_scaled
log_power_any:
        jsr log_of_short
        clc
        lda acc
        adc prod+3
        sta acc
        lda acc+1
        adc prod+4
        bvc log_power_fits
        lda #$7f
log_power_fits:
        sta acc+1
        lda prod+7
        pha
        lda prod+5
        pha
        jsr log_units
        pla
        sta prod+5
        pla
        sta prod+7
log_power_scaled:
        lda log_side        ; below 1 to a power above 0, or the other way round
        eor prod+5
        jsr log_power_of
        lda prod+7
        sta acc+2
        rts

; acc = acc times log_c, at most 32767.
log_times:
        lda acc
        sta log_z
        lda acc+1
        sta log_z+1
        lda #0
        sta acc
        sta acc+1
log_times_next:
        lsr log_c+1
        ror log_c
        bcc log_times_even
        clc
        lda acc
        adc log_z
        sta acc
        lda acc+1
        adc log_z+1
        sta acc+1
        bmi log_times_most
log_times_even:
        lda log_c
        ora log_c+1
        beq log_times_done
        asl log_z
        rol log_z+1
        bpl log_times_next
log_times_most:
        jmp log_most
log_times_done:
        rts
