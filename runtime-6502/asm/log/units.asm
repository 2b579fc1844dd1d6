; acc = the whole number nearest to 2^(acc/1024), at most 32767, two bytes: from 256 on in
; proportion between entries of the table of whole numbers' logarithms.
log_units:
        lda acc+1
        bmi log_units_few
        cmp #15*log_octave
        bcc log_units_fit
        lda #$7f
        sta acc+1
        lda #$ff
        sta acc
        rts
log_units_fit:
        cmp #8*log_octave
        bcs log_units_many
log_units_few:
        clc                 ; half of twice as many, and a half
        adc #log_octave
        sta acc+1
        jsr log_whole
        inc acc
        bne log_units_half
        inc acc+1
log_units_half:
        lsr acc+1
        ror acc
        rts
log_units_many:
        ldx #0              ; by how many octaves less than nine
        stx prod
log_units_octave:
        cmp #9*log_octave
        bcc log_units_mantissa
        sbc #log_octave
        inc prod
        bne log_units_octave
log_units_mantissa:
        sta acc+1
        lda acc
        sta prod+2
        jsr log_whole
        jsr log_of_acc
        sta prod+4
        stx prod+5
        sec                 ; what is left of the logarithm
        lda prod+2
        sbc prod+4
        sta prod+2
        lda #0
        sta prod+3
        lda acc
        sta prod+6
        lda acc+1
        sta prod+7
        inc acc             ; of the next
        bne log_units_next
        inc acc+1
log_units_next:
        jsr log_of_acc
        sec
        sbc prod+4
        sta prod+4
        lda prod+6
        sta acc
        lda prod+7
        sta acc+1
        ldx prod
        beq log_units_divide
log_units_twice:
        asl acc
        rol acc+1
        asl prod+2
        rol prod+3
        dex
        bne log_units_twice
log_units_divide:
        lda prod+4          ; in gaps, to the nearest
        lsr
        clc
        adc prod+2
        sta prod+2
        bcc log_units_gap
        inc prod+3
log_units_gap:
        sec
        lda prod+2
        sbc prod+4
        sta prod+2
        lda prod+3
        sbc #0
        sta prod+3
        bcc log_units_done
        inc acc
        bne log_units_gap
        inc acc+1
        bne log_units_gap
log_units_done:
        rts
