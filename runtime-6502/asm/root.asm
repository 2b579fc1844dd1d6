; acc = square root of acc in 16.16, to the nearest; 0 for a negative.
; Bit by bit: the root of the 48-bit number acc * 65536 has 24 bits. With the
; root so far r and d = 4 r + 1, a bit is 1 where the remainder, two bits
; longer, is not below d. The remainder is in prod, d in prod+4; both grow, so
; there are three loops of 8 bits, each a byte wider than the one before.
root:
        lda #0
        sta prod
        sta prod+1
        sta prod+2
        sta prod+3
        sta prod+5
        sta prod+6
        sta prod+7
        lda #1
        sta prod+4
        ldx #4              ; bits of root from one byte of acc
        lda acc+3
        bmi root_zero
        bne root_byte_3
        lda acc+2
        bne root_byte_2
        beq root_low
root_zero:
        lda #0
        sta acc
        sta acc+1
        sta acc+2
        sta acc+3
        rts

root_byte_3:
        sta bits
        jsr root_narrow
        lda acc+2
root_byte_2:
        sta bits
        jsr root_narrow
root_low:                   ; nothing is left above acc+1
        lda acc+1
        sta bits
        jsr root_wide
        lda acc
        sta bits
        jsr root_wide
        ldx #8
root_last:                  ; the 16 bits below acc are 0
        asl prod
        rol prod+1
        rol prod+2
        rol prod+3
        asl prod
        rol prod+1
        rol prod+2
        rol prod+3
        sec
        lda prod
        sbc prod+4
        sta low
        lda prod+1
        sbc prod+5
        sta carried
        lda prod+2
        sbc prod+6
        tay
        lda prod+3
        sbc prod+7
        bcc root_last_0
        sta prod+3
        sty prod+2
        lda carried
        sta prod+1
        lda low
        sta prod
        lda prod+4          ; d = 2 d + 3
        asl
        eor #7
        bne root_last_d
root_last_0:
        lda prod+4          ; d = 2 d - 1
        asl
        eor #3
root_last_d:
        sta prod+4
        rol prod+5
        rol prod+6
        rol prod+7
        dex
        bne root_last
        lsr prod+7          ; the root is d / 4
        ror prod+6
        ror prod+5
        ror prod+4
        lsr prod+7
        ror prod+6
        ror prod+5
        ror prod+4
        lda prod+4          ; and one more where the remainder is above the root
        cmp prod
        sta acc
        lda prod+5
        sta acc+1
        sbc prod+1
        lda prod+6
        sta acc+2
        sbc prod+2
        lda #0
        sta acc+3
        sbc prod+3
        bcs root_done
        inc acc
        bne root_done
        inc acc+1
        bne root_done
        inc acc+2
root_done:
        rts

root_narrow:                ; four bits, remainder and d in 16 bits
        asl bits
        rol prod
        rol prod+1
        asl bits
        rol prod
        rol prod+1
        sec
        lda prod
        sbc prod+4
        tay
        lda prod+1
        sbc prod+5
        bcc root_narrow_0
        sta prod+1
        sty prod
        lda prod+4
        asl
        eor #7
        bne root_narrow_d
root_narrow_0:
        lda prod+4
        asl
        eor #3
root_narrow_d:
        sta prod+4
        rol prod+5
        dex
        bne root_narrow
        ldx #4
        rts

root_wide:                  ; four bits, remainder and d in 24 bits
        asl bits
        rol prod
        rol prod+1
        rol prod+2
        asl bits
        rol prod
        rol prod+1
        rol prod+2
        sec
        lda prod
        sbc prod+4
        sta low
        lda prod+1
        sbc prod+5
        tay
        lda prod+2
        sbc prod+6
        bcc root_wide_0
        sta prod+2
        sty prod+1
        lda low
        sta prod
        lda prod+4
        asl
        eor #7
        bne root_wide_d
root_wide_0:
        lda prod+4
        asl
        eor #3
root_wide_d:
        sta prod+4
        rol prod+5
        rol prod+6
        dex
        bne root_wide
        ldx #4
        rts
