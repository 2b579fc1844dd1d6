; acc = acc less a unit of ten bits.
log_curve_less:
        sec
        lda acc
        sbc #log_unit_of_ten
        sta acc
        bcs log_curve_done
        dec acc+1
log_curve_done:
        rts
