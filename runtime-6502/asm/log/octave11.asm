; Logarithms of 11 bits behind the point: pages of an octave, and some numbers.
log_octave = 8
log_unit_of_ten = 2     ; a unit of ten bits
log_of_quarter = 1334   ; a quarter turn
log_of_half_turn = 3382   ; half a turn
log_of_natural = 23611  ; what an int of units is too large by to be a natural logarithm
log_far_pages = 100     ; from that distance on nothing is left of the smaller
