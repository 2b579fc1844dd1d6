; acc = the angle whose cosine is acc, clamped to -1..1; 16.16.
arccosine:
        jsr arccosine_wide
        jmp arctangent_round

; acc = the angle whose sine is acc, clamped to -1..1: pi/2 less that of the cosine.
arcsine:
        jsr arccosine_wide
        sec
        lda #$44
        sbc prod
        sta prod
        lda #$b5
        sbc prod+1
        sta prod+1
        lda #$1f
        sbc prod+2
        sta prod+2
        lda #$92
        sbc prod+3
        sta prod+3
        lda #1
        sbc prod+4
        sta prod+4
        jmp arctangent_round

; prod = the angle with 32 bits behind the point: twice that of
; (root of 1 - x, root of 1 + x), which loses nothing near 1 and -1.
arccosine_wide:
        lda acc+3           ; x within -1..1?
        bmi arccosine_minus
        ora acc+2
        beq arccosine_fits
        lda #1
        bne arccosine_clamp
arccosine_minus:
        and acc+2
        cmp #$ff
        beq arccosine_fits
        lda #$ff
arccosine_clamp:
        ldx #0
        stx acc
        stx acc+1
        sta acc+2
arccosine_fits:
        lda acc
        sta arccosine_x
        lda acc+1
        sta arccosine_x+1
        lda acc+2
        sta arccosine_x+2
        sec                 ; 1 - x
        lda #0
        sbc acc
        sta acc
        lda #0
        sbc acc+1
        sta acc+1
        lda #1
        sbc acc+2
        sta acc+2
        jsr arccosine_root
        ldx #3
arccosine_keep:
        lda acc,x
        sta arccosine_up,x
        dex
        bpl arccosine_keep
        lda arccosine_x
        sta acc
        lda arccosine_x+1
        sta acc+1
        clc                 ; 1 + x
        lda arccosine_x+2
        adc #1
        sta acc+2
        jsr arccosine_root
        ldx #3
arccosine_place:
        lda acc,x
        sta arg,x
        lda arccosine_up,x
        sta acc,x
        dex
        bpl arccosine_place
        jsr arctangent
        asl prod
        rol prod+1
        rol prod+2
        rol prod+3
        rol prod+4
        rts

; acc = 2^6.5 times the root of the three bytes of acc, at most 2.
arccosine_root:
        ldx acc             ; times 2^16
        ldy acc+1
        lda acc+2
        stx acc+2
        sty acc+3
        ldx #0
        stx acc
        stx acc+1
        ldx #3              ; by 8
arccosine_eighth:
        lsr
        ror acc+3
        ror acc+2
        ror acc+1
        dex
        bne arccosine_eighth
        jmp root
arccosine_x:
        .byte 0, 0, 0
arccosine_up:
        .byte 0, 0, 0, 0
