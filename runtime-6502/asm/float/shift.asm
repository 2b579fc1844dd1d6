; The mantissa in @ and float_guard over 2^a, cut.
float_shift_@:
        cmp #40
        bcs float_gone_@
float_bytes_@:
        cmp #8
        bcc float_bits_@
        sbc #8
        ldx @
        stx float_guard
        ldx @+1
        stx @
        ldx @+2
        stx @+1
        ldx @+3
        stx @+2
        ldx #0
        stx @+3
        beq float_bytes_@
float_bits_@:
        tax
        beq float_shifted_@
        lda @+3
float_bit_@:
        lsr
        ror @+2
        ror @+1
        ror @
        ror float_guard
        dex
        bne float_bit_@
        sta @+3
float_shifted_@:
        rts
float_gone_@:
        lda #0
        sta @
        sta @+1
        sta @+2
        sta @+3
        sta float_guard
        rts
