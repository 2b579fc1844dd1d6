; a, x = 0: what a summand adds that is 6 octaves smaller or more; y a = by how much. Steps
; are counted, from that on at which the page's first stands. Leaves the carry clear.
log_rest:
        sta log_n+1
        sty log_n
        tax
        lda log_rest_first-24,x
        tax
log_rest_next:
        lda log_rest_high,x
        cmp log_n+1
        bne log_rest_told
        lda log_rest_low,x
        cmp log_n
        bcc log_rest_told
        inx
        bne log_rest_next
log_rest_told:
        txa
        ldx #0
        clc
        rts
