; a = the greatest whole number whose square is not above a (high) and acc. Of numbers from
; 2^14 on the upper byte tells the root but for one, and the lower byte tells that: squares are
; further apart than 256 there. Smaller ones are taken times 4, as often as that needs.
isqrt16:
        cmp #$40
        bcc isqrt16_small
        tay
        lda acc
        cmp isqrt_next-64,y
        lda isqrt_root-64,y
        adc #0
        rts
isqrt16_small:
        ldx #0
        tay
        bne isqrt16_up
        lda acc             ; eight bits at once
        beq isqrt16_done
        sty acc
        ldx #4
        cmp #$40
        bcs isqrt16_look
isqrt16_up:                 ; at most 3 turns
        inx
        asl acc
        rol
        asl acc
        rol
        cmp #$40
        bcc isqrt16_up
isqrt16_look:
        tay
        lda acc
        cmp isqrt_next-64,y
        lda isqrt_root-64,y
        adc #0
isqrt16_down:               ; at most 7 turns
        lsr
        dex
        bne isqrt16_down
isqrt16_done:
        rts

; a = the root of half of a (high) and acc, rounded, in 8 bits; 0 of what is below 0.
root8:
        asl acc
        rol
        bcs root8_zero
        jsr isqrt16
        lsr
        adc #0
        bpl root8_done
        lda #$7f
root8_done:
        rts
root8_zero:
        lda #0
        rts
