; Logarithms of 10 bits behind the point: pages of an octave, and some numbers.
log_octave = 4
log_unit_of_ten = 1     ; a unit of ten bits
log_of_quarter = 667    ; a quarter turn
log_of_half_turn = 1691   ; half a turn
log_of_natural = 10781  ; what an int of units is too large by to be a natural logarithm
log_far_pages = 47      ; from that distance on nothing is left of the smaller
