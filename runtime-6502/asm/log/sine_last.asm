log_sine_last:              ; by which two of the last 512 units
        lsr
        lda log_z
        ror
        tay
        lda log_sine_last_units,y
        sta acc
        beq log_sine_one
        lda #$ff
log_sine_one:
        sta acc+1
        rts
